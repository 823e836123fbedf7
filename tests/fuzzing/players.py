# SPDX-License-Identifier: GPL-3.0-or-later
"""Who plays: each loads what it needs, and only that."""

from .sequences import Player

BLENDER = "blender"
PLAYERS = (BLENDER, "scenarios", "folders")


def player_named(name: str) -> type[Player]:
    """Return the class of a player."""
    if name == BLENDER:
        from .blender_steps import BlenderPlayer

        return BlenderPlayer
    if name == "scenarios":
        from .scenario_steps import ScenarioPlayer

        return ScenarioPlayer
    from .folder_steps import FolderPlayer

    return FolderPlayer
