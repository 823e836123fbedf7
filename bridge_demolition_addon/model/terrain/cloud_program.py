"""The program that unpacks a point cloud: see `point_cloud`, which starts it."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...errors import UnreadableError
from ...system.isolated import answer


def main() -> None:
    """Answer the request: read a cloud, and leave its points in a file."""
    answer(_unpacked)


def _unpacked(request: dict[str, Any]) -> dict[str, Any]:
    import laspy

    with laspy.open(request["path"]) as reader:
        count = int(reader.header.point_count)
        if count > request["most_points"]:
            raise UnreadableError(f"holds {count} points: expected at most {request['most_points']}; thin it out first")
        cloud = reader.read()
    points = np.column_stack([np.asarray(axis, float) for axis in (cloud.x, cloud.y, cloud.z)])
    classes = np.asarray(cloud.classification, np.uint8)
    kept = np.isfinite(points).all(axis=1)
    np.savez(request["kept"], points=points[kept], classes=classes[kept])
    return {"points": int(kept.sum())}
