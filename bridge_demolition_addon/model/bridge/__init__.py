"""The bridge as solids: deck, girders, piers, pier caps and abutments, placed on the ground.

x runs along the road from the axis of the first pier, y across it from its middle, z up from the ground.
"""

from ..scenario.bridge_checks import deck_top, deck_top_at, deck_underside
from .parametric import bridge_density, bridge_members

__all__ = ["bridge_density", "bridge_members", "deck_top", "deck_top_at", "deck_underside"]
