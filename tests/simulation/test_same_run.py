# SPDX-License-Identifier: GPL-3.0-or-later
"""The same scenario gives the same run, whatever numpy, OpenBLAS and the C library choose by processor and cores."""

import csv
import json
import warnings
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from support.checkout import TESTS
from support.long_cases import long_but
from support.processes import run_program

pytestmark = pytest.mark.long  # tests/engineering/test_same_bits.py shows it of models, blast and short runs

SCENARIOS = {
    "blast": TESTS / "simulation" / "same_run" / "blast.toml",
    "everything": TESTS / "simulation" / "same_run" / "everything.toml",  # strength, reinforcement, saw cut, charge
    "i235": TESTS / "simulation" / "same_run" / "i235.toml",
}
NUMPY_AS_OLD = {
    "NPY_DISABLE_CPU_FEATURES": " ".join(np.show_config(mode="dicts")["SIMD Extensions"].get("found", ())),
}
FMA = ("FMA", "FMA4", "AVX2")
C_LIBRARY_AS_OLD = {  # before glibc 2.33 their names had an ending
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=" + ",".join(f"-{name}{ending}" for name in FMA for ending in ("", "_Usable")),
}
CPU_INFORMATION = Path("/proc/cpuinfo")


@dataclass(frozen=True)
class Machine:
    """A processor to be like: what OpenBLAS's kernels for it need, what else is as on an older one, and cores."""

    kernel: str
    flags: tuple[str, ...]
    cores: int
    older: dict[str, str] = field(default_factory=dict)

    @property
    def environment(self) -> dict[str, str]:
        threads = str(self.cores)
        counts = {"OPENBLAS_NUM_THREADS": threads, "OMP_NUM_THREADS": threads}
        return {"OPENBLAS_CORETYPE": self.kernel} | counts | self.older


MACHINES = (
    Machine("Prescott", ("pni",), 1, NUMPY_AS_OLD | C_LIBRARY_AS_OLD),
    Machine("Nehalem", ("sse4_2",), 2, C_LIBRARY_AS_OLD),
    Machine("Sandybridge", ("avx",), 1, NUMPY_AS_OLD),
    Machine("Haswell", ("avx2", "fma"), 1),  # and for Zen, of which numpy has no kernels of its own
    Machine("SkylakeX", ("avx512f", "avx512cd", "avx512bw", "avx512dq", "avx512vl"), 2, C_LIBRARY_AS_OLD),
)


def run_all(folder, cores, **environment):
    """Run the scenarios in one process; what it calculated with."""
    arguments = ("run", *SCENARIOS.values(), "--output", folder, "--no-pictures")
    done = run_program("bda_and_its_arithmetic", cores, *arguments, **environment)
    assert (done.returncode, done.stderr) == (0, "")
    return json.loads(done.stdout.splitlines()[0])


def logs_in(folder):
    """Names of a run's logs, of which that of explosions is there where something exploded."""
    return sorted(path.name for path in folder.glob("*_log.csv"))


def summary_of(folder):
    """What a run's summary says that does not depend on the time it took."""
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    del summary["wall_time_s"]
    return summary


@pytest.fixture(scope="module")
def usual(tmp_path_factory):
    """Folder of the runs as this machine makes them, and what they were calculated with."""
    folder = tmp_path_factory.mktemp("usual")
    return folder, run_all(folder, 2, OPENBLAS_NUM_THREADS="2", OMP_NUM_THREADS="2")


def test_much_comes_to_pass_in_these_runs(usual):
    folder, _ = usual
    summaries = {name: summary_of(folder / name) for name in SCENARIOS}
    assert all(summary["connections"]["broken"] > 10 for summary in summaries.values())
    assert all(len(logs_in(folder / name)) >= 3 for name in SCENARIOS)
    assert summaries["i235"]["impact"]["time_s"] > 0.2
    assert summaries["blast"]["charges"] and summaries["everything"]["charges"]
    for name in ("blast", "everything"):
        with (folder / name / "explosion_log.csv").open(encoding="utf-8", newline="") as file:
            assert len(list(csv.reader(file))) > 1


@pytest.mark.parametrize("name", SCENARIOS)
def test_precision_is_chosen_by_us_alone(usual, name):
    """Blender's vectors become arrays of single precision in some of its versions, and of double in others.

    What is kept of each body and connection in each frame is in single precision, all else in double.
    """
    folder, _ = usual
    with np.load(folder / name / "results.npz") as arrays:
        frames = len(arrays["frames"])
        fractions = {key: arrays[key] for key in arrays if arrays[key].dtype.kind == "f"}
    of_frames = {key for key, values in fractions.items() if values.ndim > 1 and len(values) == frames}
    assert {key for key, values in fractions.items() if values.dtype == np.float32} == of_frames > {"places_m"}
    assert {values.dtype for key, values in fractions.items() if key not in of_frames} == {np.dtype(np.float64)}


@pytest.mark.parametrize("machine", long_but(MACHINES[:1], MACHINES), ids=lambda machine: machine.kernel)
def test_runs_are_the_same_on_another_processor(usual, tmp_path, machine):
    flags = CPU_INFORMATION.read_text().split() if CPU_INFORMATION.exists() else []
    if missing := [flag for flag in machine.flags if flag not in flags]:
        pytest.skip(f"the kernels for {machine.kernel} need {' and '.join(missing)}, which this processor lacks")
    folder, arithmetic = usual
    other = run_all(tmp_path, machine.cores, **machine.environment)
    check_effect(machine, arithmetic, other)
    for name in SCENARIOS:
        assert logs_in(tmp_path / name) == logs_in(folder / name)
        for log in logs_in(folder / name):
            assert (tmp_path / name / log).read_bytes() == (folder / name / log).read_bytes(), (name, log)
        assert summary_of(tmp_path / name) == summary_of(folder / name)


def check_effect(machine, usual, other):
    """Hold what a process calculated with against what it was told to; say so where numpy has no such kernel."""
    if other["kernel"] != machine.kernel:
        warnings.warn(
            f"numpy has no kernels for {machine.kernel} here: tried those for {other['kernel']}", stacklevel=1
        )
    assert other["cores"] <= machine.cores and other["threads"] in (None, machine.cores)
    for part, older in (("numpy", NUMPY_AS_OLD), ("c_library", C_LIBRARY_AS_OLD)):
        if older.items() <= machine.older.items() and other[part] == usual[part]:
            warnings.warn(f"{part} calculates here as on an older processor in any case", stacklevel=1)
