# SPDX-License-Identifier: GPL-3.0-or-later
"""A model has the same bits on every processor and Python: what differs between these is not used for it.

Numpy and OpenBLAS choose by processor. `sum` adds floats with a correction for rounding since Python 3.12, and without
one before; `math.fsum` rounds once in all of them.
"""

import ast
import re

import numpy as np
import pytest
from support.checkout import EXAMPLES, REPORT_2019, ROOT
from support.processes import run_program

PACKAGE = ROOT / "bridge_demolition_addon"
ENGINEERING, MODEL = PACKAGE / "engineering", PACKAGE / "model"
# The rooms that design bars are not among them: what these choose comes in steps, of millimetres and whole bars.
ROOMS_OF_ENGINEERING = (
    *("blast", "elasticity", "fracture", "geometry", "mechanics", "statistics", "structure", "terrain", "timing"),
)
ROOMS_OF_MODEL = (
    *("blast", "bridge", "debris", "materials", "results"),
    *("scenario", "sequence", "structure", "study", "terrain"),
)
SCENE, SIMULATION = PACKAGE / "scene", PACKAGE / "simulation"
FOLDERS = [
    *(ENGINEERING / room for room in ROOMS_OF_ENGINEERING),
    *(MODEL / room for room in ROOMS_OF_MODEL),
    PACKAGE / "bullet",
    *(SCENE, SCENE / "blast", SCENE / "connections", SCENE / "tools"),
    *(SIMULATION, SIMULATION / "recording"),
]
MODULES = [path for folder in FOLDERS for path in sorted(folder.glob("*.py"))]

# Products by BLAS and LAPACK, functions of which numpy or the C library have one version for each processor, and what
# leaves equal values in an order of its own.
BY_PROCESSOR = {
    *("dot", "einsum", "inner", "linalg", "matmul", "tensordot", "vdot"),
    *("arccos", "arcsin", "arctan", "arctan2", "cbrt", "cos", "cosh", "exp", "exp2", "expm1", "float_power", "hypot"),
    *("log", "log10", "log1p", "log2", "power", "sin", "sinc", "sinh", "tan", "tanh", "geomspace", "logspace"),
    *("acos", "asin", "atan", "atan2", "pow"),
    *("argpartition", "convolve", "corrcoef", "correlate", "cov", "lstsq", "polyfit"),
}
METHODS = {"argpartition", "dot"}
QUANTITY = re.compile(r"_(m|m2|m3|mm|kg|n|nm|pa|j|s)\b|\b(area|depth|force|mass|volume|width)s?\b|[a-z] \* [a-z]")
DRAWN_BY_LOGARITHMS = {"exponential", "multinomial", "normal", "poisson", "standard_normal"}


def chosen_by_processor(text):
    """Lines of a program that use something which differs by processor."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.BinOp | ast.AugAssign) and (isinstance(node.op, ast.MatMult) or is_power(node)):
            yield node.lineno
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and sorts_or_multiplies(node):
            yield node.lineno
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and adds_quantities(node):
            yield node.lineno
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            known = DRAWN_BY_LOGARITHMS if node.value.id == "generator" else BY_PROCESSOR
            if node.value.id in ("np", "math", "generator") and node.attr in known:
                yield node.lineno


def is_power(node):
    """Whether the C library may be asked for a power, even for a square: of single numbers, but not of constants."""
    constants = isinstance(node, ast.BinOp) and all(
        isinstance(operand, ast.Constant) for operand in (node.left, node.right)
    )
    return isinstance(node.op, ast.Pow) and not constants


def adds_quantities(call):
    """Whether `sum` adds what has a unit, or products: numbers that are no counts, and no arrays."""
    if call.func.id != "sum":
        return False
    added = ast.unparse(call.args[0].elt if isinstance(call.args[0], ast.GeneratorExp) else call.args[0])
    return bool(QUANTITY.search(added)) and "None, :" not in added and "np." not in added


def sorts_or_multiplies(call):
    """Whether a method or function gives an order of equal values, or a product, that is not always the same."""
    keywords = {keyword.arg: keyword.value for keyword in call.keywords}
    kind = keywords.get("kind")
    stable = isinstance(kind, ast.Constant) and kind.value == "stable"
    is_of_numpy = isinstance(call.func.value, ast.Name) and call.func.value.id == "np"
    return (call.func.attr == "argsort" and not stable) or (call.func.attr in METHODS and not is_of_numpy)


@pytest.mark.parametrize(
    "line",
    [
        *("a @ b", "a @= b", "np.linalg.norm(a)", "np.dot(a, b)", "a.dot(b)", "math.cos(b)", "generator.normal()"),
        *("sum(body.mass_kg for body in bodies)", "sum(areas)", "sum(a * b for a, b in pairs)"),
        *("a**2", "a **= 2", "2.0**a", "np.argsort(a)", "a.argsort()", "np.argpartition(a, 2)", "a.argpartition(2)"),
    ],
)
def test_what_differs_by_processor_is_found(line):
    assert list(chosen_by_processor(f"c = 1\n{line}\n")) == [2]


@pytest.mark.parametrize(
    "line",
    [
        *("np.sqrt(a)", "np.square(a)", "generator.random()", "2**20", "np.argsort(a, kind='stable')", "dot(a, b)"),
        *("math.fsum(areas_m2)", "sum(zone.holes for zone in zones)", "sum(a[:, None, :] * b for a, b in pairs)"),
    ],
)
def test_what_is_the_same_on_every_processor_is_let_pass(line):
    assert not list(chosen_by_processor(line))


def test_no_module_uses_what_differs_by_processor():
    assert len(MODULES) > 250
    found = {str(path): list(chosen_by_processor(path.read_text(encoding="utf-8"))) for path in MODULES}
    assert {path: lines for path, lines in found.items() if lines} == {}


def processor_features():
    """Names by which numpy can be told not to use what this processor has."""
    simd = np.show_config(mode="dicts")["SIMD Extensions"]
    return " ".join(simd.get("found", []))


@pytest.mark.slow
@pytest.mark.parametrize(
    "program, argument",
    [
        ("bits_of_a_model", REPORT_2019 / "i235_one_span.toml"),
        pytest.param("bits_of_a_model", EXAMPLES / "three_span_box_girder.toml", marks=pytest.mark.long),
        ("bits_of_a_blast", 200),
        pytest.param("bits_of_a_run", ROOT / "tests" / "simulation" / "everything.toml", marks=pytest.mark.long),
    ],
)
def test_results_have_the_same_bits_on_an_older_processor_and_on_one_core(program, argument):
    older = {"NPY_DISABLE_CPU_FEATURES": processor_features(), "OPENBLAS_CORETYPE": "Nehalem"}
    runs = [run_program(program, argument), run_program(program, argument, "one core", **older)]
    assert [(run.returncode, run.stderr) for run in runs] == [(0, ""), (0, "")]
    digests = [run.stdout.splitlines()[-1] for run in runs]  # Blender has a line of its own
    assert re.fullmatch(r"[0-9a-f]{64}", digests[0])
    assert digests[0] == digests[1]
