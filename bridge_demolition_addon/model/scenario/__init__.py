"""A scenario: the bridge, how it is broken into shards and what hits it, as checked values.

x runs along the road with the axis of the first pier at 0, y across it with 0 in its middle, z up with the ground at 0.
The deck, with its girders, lies on the pier caps, or on the piers where there are no caps. One module for each group of
tables.
"""

from ..blast.blast_zones import BlastZone
from ..blast.charges import Charge
from ..blast.cuts import MemberCut
from ..blast.settings import BlastSettings
from ..blast.vibration_laws import VibrationLaw
from ..changes.removals import Removal, Weakening
from ..changes.saw_cuts import SawCut, TendonCut
from ..lifts import Lift
from ..loads.loads import Load
from ..materials import BarLayer, Material
from ..pulls import Pull
from .alignment import Alignment
from .arch import Arch, RigidFrame
from .ball import Ball, BallCable, BallHit
from .bodies import Equipment, Ground, GroundSurface, ShardSettings, Support
from .bridge import Bridge
from .bridge_parts import Abutments, BoxGirder, Deck, Girders, OtherPiers, PierCaps, Piers, Voids
from .connections import ConnectionSettings
from .contacts import ContactSettings, SurfaceValues
from .dead_loads import DeadLoad
from .fracture import Finer, FracturePoint, FractureSettings, MemberFracture
from .geometry import Geometry
from .girders import GirderSpan
from .half_joints import HalfJoint
from .haunches import Haunches
from .jackhammer import Jackhammer
from .joint_settings import ConnectionBetween
from .recording import PictureSettings, RecordingSettings, ReportSettings
from .reinforcement import BarRule, BridgeReinforcement, GeometryReinforcement, RatiosOfMember
from .scenario import Scenario
from .site import Exclusion, Neighbour, Site, Zone
from .steelwork import SteelMember, SteelNode, Steelwork
from .tendons import Tendon
from .time import TimeSettings
from .trusses import TrussSpan

__all__ = [
    "Abutments",
    "Alignment",
    "Arch",
    "Ball",
    "BallCable",
    "BallHit",
    "BarLayer",
    "BarRule",
    "BlastSettings",
    "BlastZone",
    "BoxGirder",
    "Bridge",
    "BridgeReinforcement",
    "Charge",
    "ConnectionBetween",
    "ConnectionSettings",
    "ContactSettings",
    "DeadLoad",
    "Deck",
    "Equipment",
    "Exclusion",
    "Finer",
    "FracturePoint",
    "FractureSettings",
    "Geometry",
    "GeometryReinforcement",
    "GirderSpan",
    "Girders",
    "Ground",
    "GroundSurface",
    "HalfJoint",
    "Haunches",
    "Jackhammer",
    "Lift",
    "Load",
    "Material",
    "MemberCut",
    "MemberFracture",
    "Neighbour",
    "OtherPiers",
    "PictureSettings",
    "PierCaps",
    "Piers",
    "Pull",
    "RatiosOfMember",
    "RecordingSettings",
    "Removal",
    "ReportSettings",
    "RigidFrame",
    "SawCut",
    "Scenario",
    "ShardSettings",
    "Site",
    "SteelMember",
    "SteelNode",
    "Steelwork",
    "Support",
    "SurfaceValues",
    "Tendon",
    "TendonCut",
    "TimeSettings",
    "TrussSpan",
    "VibrationLaw",
    "Voids",
    "Weakening",
    "Zone",
]
