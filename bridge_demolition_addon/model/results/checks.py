"""Checks of arrays read from the files of a run, before anything is calculated from them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np

from ...engineering.geometry.vectors import product
from ...errors import OutputError
from ...system.array_files.archive import blocks_of
from ..schema import LARGEST_NUMBER

_FARTHEST_M = 1e7
"""Farther than any debris flies."""

_ROTATION_SLACK = 1e-3
"""Single precision of Blender, turned on over thousands of frames."""

_ARRAYS = {
    ("U", ""): "reading",
    ("i", "k"): "frames",
    ("f", "k"): "times_s substep_s",
    ("f", "kn3"): "places_m velocities_m_s spins_rad_s",
    ("f", "kn33"): "rotations",
    ("b", "kn"): "asleep",
    ("b", "km"): "intact",
    ("U", "n"): "body_names body_kinds body_members body_member_kinds",
    ("f", "n"): "masses_kg volumes_m3",
    ("f", "v3"): "vertices_m",
    ("i", "n"): "vertex_counts triangle_counts",
    ("U", "m"): "connection_names",
    ("i", "m2"): "pairs",
    ("f", "m3"): "points_m",
    ("f", "m"): "areas_m2",
    ("nan", "m3"): "normals",
    ("nan", "m22"): "second_moments_m4",
    ("i", "t3"): "triangles",
    ("nan", "kn3"): "blast_impulses_ns body_forces_n body_contact_impulses_ns",
    ("nan", "kn"): "body_peaks_n body_sums_n body_peak_sums_n body_signed_2019_n von_mises_pa made_by_solver_j "
    "body_bar_use",
    ("nan", "kn33"): "stresses_pa",
    ("nan", "km3"): "connection_forces_n connection_moments_nm connection_peak_forces_n connection_peak_moments_nm",
    ("nan", "km"): "connection_peaks_n connection_bars",
    ("nan", "k"): "work_of_gravity_j work_of_loads_j work_of_tools_j lost_to_damping_j dissipated_between_bodies_j "
    "dissipated_by_bars_j dissipated_by_crack_friction_j made_by_connections_j made_by_contacts_j made_by_lifting_j",
    ("i", "b"): "balls",
    ("f", "s"): "ball_times_s",
    ("nan", "sb3"): "ball_impulses_ns ball_velocities_m_s",
    ("i", "c"): "contact_frames",
    ("i", "c2"): "contact_bodies",
    ("f", "c3"): "contact_places_m contact_normals contact_friction_impulses_ns",
    ("f", "c"): "contact_normal_impulses_ns",
}
"""Names of arrays in the file by kind and shape, with the letters of `Results`' parts: n bodies, m connections,
k frames, v vertices, t triangles, b balls, s sub-steps, c contacts. In those of kind nan, that stands for numbers that
were not recorded; in all others every number is known."""

_KINDS = {
    "U": ("texts", "U"),
    "i": ("whole numbers", "iu"),
    "f": ("fractions", "f"),
    "nan": ("fractions", "f"),
    "b": ("true or false", "b"),
}


def check_arrays(arrays: Mapping[str, np.ndarray]) -> None:
    """Check that arrays by their names in the file have the kinds, shapes and sizes of a run's."""
    lengths: dict[str, tuple[int, str]] = {}
    for (kind, shape), names in _ARRAYS.items():
        for name in names.split():
            if name in arrays:
                _check_kind(name, arrays[name], kind)
                _check_shape(name, arrays[name], shape, lengths)
                _check_sizes(name, arrays[name], kind)
    _check_order(arrays)
    bodies = len(arrays["body_names"])
    for name, least, most in (("pairs", -1, bodies), ("balls", 0, bodies), ("vertex_counts", 0, 2**31)):
        wanted = f"whole numbers from {least} to {most - 1}"
        _expect(name, arrays[name], partial(_is_within, least, most), wanted)
    total = int(arrays["vertex_counts"].sum())
    if total != len(arrays["vertices_m"]):
        raise OutputError(f"vertex_counts: add up to {total}, expected {len(arrays['vertices_m'])}, as in vertices_m")
    _check_triangles(arrays)
    _check_contacts(arrays)


def _check_triangles(arrays: Mapping[str, np.ndarray]) -> None:
    """Check that triangles, which only ground that is not flat has, are of vertices of their own bodies."""
    if "triangles" not in arrays and "triangle_counts" not in arrays:
        return
    for name in ("triangles", "triangle_counts"):
        if name not in arrays:
            raise OutputError(f"{name}: is missing")
    triangles, counts = arrays["triangles"], arrays["triangle_counts"]
    _expect("triangle_counts", counts, lambda values: values >= 0, "no negative numbers")
    if (total := int(counts.sum())) != len(triangles):
        raise OutputError(f"triangle_counts: add up to {total}, expected {len(triangles)}, as in triangles")
    most = np.repeat(arrays["vertex_counts"], counts)[:, None]
    if not ((triangles >= 0) & (triangles < most)).all():
        raise OutputError("triangles: expected rows of the vertices of their bodies")


def _check_contacts(arrays: Mapping[str, np.ndarray]) -> None:
    """Check that contacts, where they were recorded, are of existing bodies, in order."""
    if "contact_frames" not in arrays:
        return
    _expect("contact_frames", np.diff(arrays["contact_frames"]), lambda steps: steps >= 0, "numbers that do not fall")
    bodies = len(arrays["body_names"])
    wanted = f"whole numbers from 0 to {bodies - 1}"
    _expect("contact_bodies", arrays["contact_bodies"], lambda values: (values >= 0) & (values < bodies), wanted)


def _check_kind(name: str, array: np.ndarray, kind: str) -> None:
    words, kinds = _KINDS[kind]
    if array.dtype.kind not in kinds:
        raise OutputError(f"{name}: expected {words}, found {array.dtype}")
    if kind == "U" and not can_be_written(array):
        raise OutputError(f"{name}: expected {words} in Unicode, found others")


def _check_shape(name: str, array: np.ndarray, shape: str, lengths: dict[str, tuple[int, str]]) -> None:
    """Check the shape of an array, in which a letter is the same length as in the arrays before."""
    if array.ndim != len(shape):
        raise OutputError(f"{name}: expected {len(shape)} axes, found {array.ndim}")
    for axis, (letter, length) in enumerate(zip(shape, array.shape, strict=True)):
        wanted, where = (int(letter), "") if letter.isdigit() else lengths.setdefault(letter, (length, name))
        if length != wanted:
            as_there = f", as in {where}" if where else ""
            raise OutputError(f"{name}: expected a length of {wanted}{as_there}, found {length} along axis {axis}")


def _check_sizes(name: str, array: np.ndarray, kind: str) -> None:
    if kind == "f":
        most = _FARTHEST_M if name.endswith("_m") else LARGEST_NUMBER
        _expect(name, array, lambda values: np.abs(values) <= most, f"numbers of at most {most:.3g}")
    elif kind == "nan":
        wanted = f"numbers of at most {LARGEST_NUMBER:.3g}"
        _expect(name, array, lambda values: ~(np.abs(values) > LARGEST_NUMBER), wanted)


def _check_order(arrays: Mapping[str, np.ndarray]) -> None:
    if not len(arrays["frames"]):
        raise OutputError("frames: expected at least one")
    for name in ("masses_kg", "volumes_m3", "areas_m2", "substep_s"):
        _expect(name, arrays[name], lambda values: values >= 0.0, "no negative numbers")
    for name in ("frames", "times_s", "ball_times_s"):
        _expect(name, np.diff(arrays[name]), lambda values: values >= 0, "numbers that do not fall")
    _expect("rotations", arrays["rotations"], _are_rotations, "rotation matrices")
    _expect("frames", arrays["frames"], lambda values: np.abs(values) < 2**31, "frames of Blender")


def _are_rotations(matrices: np.ndarray) -> np.ndarray:
    turned = product(matrices, np.swapaxes(matrices, -1, -2))
    return np.abs(turned - np.eye(3)) < _ROTATION_SLACK


def _is_within(least: int, most: int, values: np.ndarray) -> np.ndarray:
    return (values >= least) & (values < most)


def _expect(name: str, array: np.ndarray, holds: Callable[[np.ndarray], np.ndarray], wanted: str) -> None:
    if not all(holds(block).all() for block in blocks_of(array)):
        raise OutputError(f"{name}: expected {wanted}")


def can_be_written(texts: np.ndarray) -> bool:
    """Return whether texts hold letters of Unicode alone, and no halves of them (surrogates)."""
    letters = np.frombuffer(np.ascontiguousarray(texts, texts.dtype.newbyteorder("=")).tobytes(), np.uint32)
    return not ((letters > 0x10FFFF) | ((letters >= 0xD800) & (letters < 0xE000))).any()
