"""The program that unpacks a point cloud: see `point_files`, which starts it."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import UnreadableError
from ...system.isolated import answer


def main() -> None:
    """Answer the request: read a cloud, and leave its points in a file."""
    answer(_unpacked)


_POINTS_AT_ONCE = 2_000_000

_HEADER, _OF_1_4 = struct.Struct("<4s20xBB68xHIIBHI"), struct.Struct("<QIQ")
_START_OF_1_4, _HEADS = 235, (54, 60)
"""Where the header has what came with version 1.4, and bytes before each record and each extended record in a file, by
ASPRS, *LAS specification 1.4*, tables 3, 5 and 6."""


def _unpacked(request: dict[str, Any]) -> dict[str, Any]:
    import laspy

    _check_claims(Path(request["path"]))
    with laspy.open(request["path"]) as reader:
        count = int(reader.header.point_count)
        if count > request["most_points"]:
            raise UnreadableError(f"holds {count} points: expected at most {request['most_points']}; thin it out first")
        pieces = list(_pieces(reader))  # what a file claims to hold takes no memory before it is there
    np.savez(
        request["kept"],
        points=np.concatenate([np.empty((0, 3)), *(points for points, _ in pieces)]),
        classes=np.concatenate([np.empty(0, np.uint8), *(classes for _, classes in pieces)]),
    )
    return {"points": sum(len(points) for points, _ in pieces)}


def _pieces(reader: Any) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield points (n, 3) whose coordinates are finite, and their classes (n,)."""
    for cloud in reader.chunk_iterator(_POINTS_AT_ONCE):
        points = np.column_stack([np.asarray(axis, float) for axis in (cloud.x, cloud.y, cloud.z)])
        kept = np.isfinite(points).all(axis=1)
        yield points[kept], np.asarray(cloud.classification, np.uint8)[kept]


def _check_claims(path: Path) -> None:
    """Refuse a file whose header claims more than there are bytes for: its reader would look for all of that."""
    size = path.stat().st_size
    with path.open("rb") as file:
        head = file.read(_START_OF_1_4 + _OF_1_4.size)
    if len(head) < _HEADER.size:
        return  # its reader says so
    _, _, minor, length, points_at, records, form, record_bytes, count = _HEADER.unpack_from(head)
    extended_at = extended = 0
    if minor >= 4 and len(head) == _START_OF_1_4 + _OF_1_4.size:
        extended_at, extended, count = _OF_1_4.unpack_from(head, _START_OF_1_4)
    is_packed = form >= 128
    needed = (
        length + records * _HEADS[0],
        points_at + (0 if is_packed else count * record_bytes),
        extended_at + extended * _HEADS[1] if extended else 0,
    )
    if max(needed) > size:
        raise UnreadableError(f"claims to hold more than its {size} bytes: it is damaged or cut short; export it again")
