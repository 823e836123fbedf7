"""What never moves, besides the ground."""

from dataclasses import dataclass
from typing import ClassVar

from ..schema import Table, key


@dataclass(frozen=True, slots=True, kw_only=True)
class Support(Table):
    """A member, or all members of a kind, that never moves: the whole of it, or its shards on one face."""

    table: ClassVar[str] = "supports"

    member: str = key("Name of a member, such as `abutment 1`, or a kind, such as `pier`; `bda check` lists the names.")
    face: str = key(
        "Which shards: all, or those with a part of the outermost face that looks down, up, backwards along the road "
        "(`start`), forwards (`end`), towards negative y (`right`) or positive y (`left`).",
        default="all",
        choices=("all", "bottom", "top", "start", "end", "right", "left"),
    )
