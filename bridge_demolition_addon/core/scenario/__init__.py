"""A scenario: the bridge, how it is broken into shards and what hits it, as checked values.

x runs along the road with the axis of the first pier at 0, y across it with 0 in its middle, z up with the ground at 0.
The deck lies on the pier caps, or on the piers where there are no caps. One module for each group of tables.
"""

from .ball import Ball, BallHit
from .blast import BlastSettings, ChargeSettings
from .bodies import Ground, ShardSettings
from .bridge import Bridge, Deck, PierCaps, Piers
from .cable import BallCable
from .changes import Change, Removal, SawCut, Weakening
from .connection_between import ConnectionBetween
from .connections import ConnectionSettings
from .fracture import FractureSettings
from .jackhammer import Jackhammer
from .output import PictureSettings, RecordingSettings
from .scenario import Scenario
from .time import TimeSettings

__all__ = [
    "Ball",
    "BallCable",
    "BallHit",
    "BlastSettings",
    "Bridge",
    "Change",
    "ChargeSettings",
    "ConnectionBetween",
    "ConnectionSettings",
    "Deck",
    "FractureSettings",
    "Ground",
    "Jackhammer",
    "PictureSettings",
    "PierCaps",
    "Piers",
    "RecordingSettings",
    "Removal",
    "SawCut",
    "Scenario",
    "ShardSettings",
    "TimeSettings",
    "Weakening",
]
