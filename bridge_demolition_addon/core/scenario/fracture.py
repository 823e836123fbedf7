"""How finely the bridge is cut."""

from dataclasses import dataclass
from typing import ClassVar

from .key import Table, key


@dataclass(frozen=True, slots=True, kw_only=True)
class FractureSettings(Table):
    """How finely the bridge is cut."""

    table: ClassVar[str] = "fracture"

    shards: int = key("Number of shards of the whole bridge.", at_least=1, at_most=1_000_000)
