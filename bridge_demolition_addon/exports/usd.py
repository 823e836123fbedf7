"""A run as a stage of USD: a transform for each body, in double precision, with its shape below it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..errors import MissingLibraryError
from ..model.results.arrays import Results
from .shapes import body_meshes, colour_of, coloured_by, frame_rate, needed_keys, quaternions

_ROOT = "/Run"

_WHOLE_CODES = 6
"""Decimals of a time code, in frames."""


def write_usd(results: Results, path: Path, tell: Callable[[int, int, str], None]) -> None:
    """Write a run; the ending of the file says how it is encoded.

    `tell` gets how many bodies are written, of how many, and a text.
    """
    pxr = _library()
    stage = pxr.Usd.Stage.CreateNew(str(path))
    codes = _prepare(pxr, stage, results)
    inventory, kinds = results.inventory, coloured_by(results.inventory)
    names = _identifiers(pxr, inventory.body_names.tolist())
    for body, mesh in enumerate(body_meshes(inventory)):
        prim = pxr.UsdGeom.Xform.Define(stage, f"{_ROOT}/{names[body]}")
        _describe(pxr, prim.GetPrim(), results, body)
        _move(pxr, prim, results, body, codes)
        if len(mesh.triangles):
            _shape(pxr, pxr.UsdGeom.Mesh.Define(stage, f"{_ROOT}/{names[body]}/Shape"), mesh, colour_of(kinds[body]))
        tell(body + 1, len(names), "bodies written")
    stage.GetRootLayer().Save()


def _library() -> Any:
    """Return the library with its parts."""
    try:
        import pxr
        from pxr import Gf, Sdf, Tf, Usd, UsdGeom, Vt  # noqa: F401
    except ModuleNotFoundError as error:
        raise MissingLibraryError(
            f"this Blender was built without USD for Python: use one from blender.org ({error})"
        ) from error
    return pxr


def _prepare(pxr: Any, stage: Any, results: Results) -> np.ndarray:
    """Set up the stage, and return the time code of each recorded frame: its number, where frames last equally long."""
    frames = results.frames
    per_second = round(frame_rate(results), 6)
    codes = np.round(int(frames.number[0]) + (frames.time_s - frames.time_s[0]) * per_second, _WHOLE_CODES)
    pxr.UsdGeom.SetStageUpAxis(stage, pxr.UsdGeom.Tokens.z)
    pxr.UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetTimeCodesPerSecond(per_second)
    stage.SetFramesPerSecond(per_second)
    stage.SetStartTimeCode(float(codes[0]))
    stage.SetEndTimeCode(float(codes[-1]))
    stage.SetDefaultPrim(pxr.UsdGeom.Xform.Define(stage, _ROOT).GetPrim())
    return codes


def _identifiers(pxr: Any, names: list[str]) -> list[str]:
    """Return names that USD allows: letters, digits and lines; where two become the same, the later has a number."""
    taken: dict[str, None] = {}
    for name in names:
        wanted = identifier = pxr.Tf.MakeValidIdentifier(name)
        number = 1
        while identifier in taken:
            number += 1
            identifier = f"{wanted}_{number}"
        taken[identifier] = None
    return list(taken)


def _describe(pxr: Any, prim: Any, results: Results, body: int) -> None:
    """Keep with a body what its name and its member are in the run, and its mass."""
    inventory, types = results.inventory, pxr.Sdf.ValueTypeNames
    texts = {
        "name": inventory.body_names,
        "kind": inventory.body_kinds,
        "member": inventory.body_members,
        "memberKind": inventory.body_member_kinds,
    }
    for name, values in texts.items():
        prim.CreateAttribute(f"bda:{name}", types.String, custom=True).Set(str(values[body]))
    prim.CreateAttribute("bda:massKg", types.Double, custom=True).Set(float(inventory.masses_kg[body]))


def _move(pxr: Any, prim: Any, results: Results, body: int, codes: np.ndarray) -> None:
    """Set where a body is in every frame; of equal frames that follow each other, in the first and the last."""
    frames, precision = results.frames, pxr.UsdGeom.XformOp.PrecisionDouble
    positions = frames.positions_m[:, body].astype(float)
    rotations = quaternions(frames.rotations[:, body])
    translate, orient = prim.AddTranslateOp(precision), prim.AddOrientOp(precision)
    keys = needed_keys(np.hstack([positions, rotations]))
    for key in keys.tolist():
        code = pxr.Usd.TimeCode(float(codes[key])) if len(keys) > 1 else pxr.Usd.TimeCode.Default()
        translate.Set(pxr.Gf.Vec3d(*positions[key].tolist()), code)
        orient.Set(pxr.Gf.Quatd(*rotations[key].tolist()), code)


def _shape(pxr: Any, prim: Any, mesh: TriangleMesh, colour: tuple[float, float, float]) -> None:
    vertices = np.ascontiguousarray(mesh.vertices, np.float32)
    prim.CreatePointsAttr(pxr.Vt.Vec3fArray.FromNumpy(vertices))
    prim.CreateFaceVertexCountsAttr([3] * len(mesh.triangles))
    prim.CreateFaceVertexIndicesAttr(mesh.triangles.ravel().tolist())
    prim.CreateSubdivisionSchemeAttr(pxr.UsdGeom.Tokens.none)
    extent = [pxr.Gf.Vec3f(*vertices.min(axis=0).tolist()), pxr.Gf.Vec3f(*vertices.max(axis=0).tolist())]
    prim.CreateExtentAttr(extent)
    prim.CreateDisplayColorAttr([pxr.Gf.Vec3f(*colour)])
