"""The stages that were checked last, of the scene that they were checked for."""

from __future__ import annotations

from dataclasses import dataclass

import bpy

from ...display.stage_contours import StageContours


@dataclass(frozen=True, slots=True, eq=False)
class CheckedStages:
    """What the panel tells.

    Attributes
    ----------
    scene : int
        Which scene, by Blender's number of it in this session.
    rows : tuple of dict
        Rows of the table of stages.
    sentences : tuple of tuple of str
        What is said of each stage: first which it is.
    members : tuple of str
        What comes down without which member.
    contours : StageContours
        Utilisation of each shard in each stage.
    """

    scene: int
    rows: tuple[dict, ...]
    sentences: tuple[tuple[str, ...], ...]
    members: tuple[str, ...]
    contours: StageContours


_checked: list[CheckedStages] = []


def keep(found: CheckedStages) -> None:
    """Tell these from now on."""
    _checked[:] = [found]


def checked_in(scene: bpy.types.Scene) -> CheckedStages | None:
    """Return what was checked for a scene last; None where nothing was, or another scene was since."""
    return next((each for each in _checked if each.scene == scene.session_uid), None)


def unregister() -> None:
    """Forget them."""
    _checked.clear()
