"""A run as one animated glTF file (GLB, version 2.0): a node for each body, in the project's axes below the root."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..model.results.arrays import Results
from ..system.progress import Progress
from .shapes import body_meshes, colour_of, coloured_by, needed_keys, quaternions

_MAGIC, _VERSION, _JSON, _BINARY = 0x46546C67, 2, 0x4E4F534A, 0x004E4942
_FLOAT, _INTEGER = 5126, 5125
_VERTICES, _INDICES = 34962, 34963
_Z_UP_TO_Y_UP = [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1]
"""Turns the project's axes into those of glTF, column by column; exact, as its numbers are whole."""


def write_gltf(results: Results, path: Path, progress: Progress) -> None:
    """Write a run, with every frame of it."""
    progress.stage(f"writing {len(results.inventory.body_names)} animated bodies")
    path.write_bytes(animated_glb(results, lambda done, total: progress.part(done, total, "bodies written")))


def animated_glb(results: Results, finished: Callable[[int, int], None] = lambda *_: None) -> bytes:
    """Return a run as the content of a GLB file; `finished` gets how many bodies are in it, and how many there are.

    Numbers are in single precision, as glTF has no other. Times begin at 0. Of frames in which a body is the same to
    the bit, the first and the last have keys.
    """
    contents = _Contents()
    meshes = body_meshes(results.inventory)
    kinds = coloured_by(results.inventory)
    materials = {kind: number for number, kind in enumerate(sorted(set(kinds)))}
    nodes: list[dict[str, Any]] = [{"name": "Run", "matrix": _Z_UP_TO_Y_UP, "children": []}]
    for body, (name, mesh) in enumerate(zip(results.inventory.body_names.tolist(), meshes, strict=True)):
        nodes[0]["children"].append(len(nodes))
        nodes.append({"name": name, **contents.shape(name, mesh, materials[kinds[body]])})
        nodes[-1] |= contents.motion(results, body, len(nodes) - 1)
        finished(body + 1, len(meshes))
    return contents.packed(nodes, [_material(kind) for kind in materials])


class _Contents:
    """The binary part of a file, and what describes it."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._length = 0
        self._views: list[dict[str, Any]] = []
        self._accessors: list[dict[str, Any]] = []
        self._meshes: list[dict[str, Any]] = []
        self._samplers: list[dict[str, Any]] = []
        self._channels: list[dict[str, Any]] = []

    def shape(self, name: str, mesh: TriangleMesh, material: int) -> dict[str, Any]:
        """Add the shape of a body, and return what its node says of it; nothing where it has none."""
        if not len(mesh.triangles):
            return {}
        positions = self._add(mesh.vertices.astype("<f4"), _FLOAT, "VEC3", target=_VERTICES, limits=True)
        corners = self._add(mesh.triangles.astype("<u4").ravel(), _INTEGER, "SCALAR", target=_INDICES)
        primitive = {"attributes": {"POSITION": positions}, "indices": corners, "material": material}
        self._meshes.append({"name": name, "primitives": [primitive]})
        return {"mesh": len(self._meshes) - 1}

    def motion(self, results: Results, body: int, node: int) -> dict[str, Any]:
        """Add the motion of a body, and return where its node is at first."""
        frames = results.frames
        positions = frames.positions_m[:, body].astype("<f4")
        rotations = np.roll(quaternions(frames.rotations[:, body]), -1, axis=1).astype("<f4")
        first = {"translation": positions[0].tolist(), "rotation": rotations[0].tolist()}
        times = (frames.time_s - frames.time_s[0]).astype("<f4")
        keys = needed_keys(np.hstack([positions, rotations]))
        if len(keys) == 1:
            return first
        clock = self._add(times[keys], _FLOAT, "SCALAR", limits=True)
        for path, values in (("translation", positions), ("rotation", rotations)):
            output = self._add(values[keys], _FLOAT, f"VEC{values.shape[1]}")
            self._channels.append({"sampler": len(self._samplers), "target": {"node": node, "path": path}})
            self._samplers.append({"input": clock, "output": output, "interpolation": "LINEAR"})
        return first

    def packed(self, nodes: Sequence[dict[str, Any]], materials: Sequence[dict[str, Any]]) -> bytes:
        """Return the whole file."""
        described: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": "Bridge Demolition Add-on"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": nodes,
            "materials": materials,
            "meshes": self._meshes,
            "accessors": self._accessors,
            "bufferViews": self._views,
            "buffers": [{"byteLength": self._length}],
        }
        if self._channels:
            described["animations"] = [{"name": "Run", "channels": self._channels, "samplers": self._samplers}]
        text = json.dumps(described, separators=(",", ":"), ensure_ascii=False).encode()
        text += b" " * (-len(text) % 4)
        binary = b"".join(self._parts)
        head = np.array([_MAGIC, _VERSION, 12 + 8 + len(text) + 8 + len(binary), len(text), _JSON], "<u4")
        return head.tobytes() + text + np.array([len(binary), _BINARY], "<u4").tobytes() + binary

    def _add(
        self, values: np.ndarray, component: int, kind: str, target: int | None = None, limits: bool = False
    ) -> int:
        """Add an array, whose numbers have four bytes each, and return the number of its accessor."""
        content = values.tobytes()
        view: dict[str, Any] = {"buffer": 0, "byteOffset": self._length, "byteLength": len(content)}
        self._views.append(view | ({"target": target} if target else {}))
        accessor: dict[str, Any] = {
            "bufferView": len(self._views) - 1,
            "componentType": component,
            "count": len(values),
            "type": kind,
        }
        if limits:
            rows = values.reshape(len(values), -1)
            accessor |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        self._accessors.append(accessor)
        self._parts.append(content)
        self._length += len(content)
        return len(self._accessors) - 1


def _material(kind: str) -> dict[str, Any]:
    colour = [*colour_of(kind), 1.0]
    looks = {"baseColorFactor": colour, "metallicFactor": 0.0, "roughnessFactor": 0.9}
    return {"name": kind, "pbrMetallicRoughness": looks, "doubleSided": True}
