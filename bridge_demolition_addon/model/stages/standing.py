"""Statics of a bridge with some of its connections gone, what is used most, and its collapse load factor."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from ...engineering.drilled_charges.cages import BareBars
from ...engineering.elasticity.equilibrium import Equilibrium
from ...engineering.elasticity.tendons import CutTendon, TendonForces
from ...engineering.mechanics.overloads import Overloads
from ...engineering.mechanics.section_cuts import ConnectionLoads, SectionForces
from ...engineering.mechanics.strength import Joint
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ..results.stability import LARGEST_FACTOR
from ..scenario import Scenario
from ..scenario.connections import MATERIAL_OF_LARGE_MODELS
from ..schema import given
from ..structure.cracking import FALLEN_SHARE, CrackedBridge, RestingModel, StandingBare, SteelBeside
from ..structure.equilibrium import at_rest, deflection_m, held_motions, inertias_of
from ..structure.model import Model
from ..structure.section_use import SectionsWithBars
from ..structure.utilisation import Utilisations

_MOST_ROUNDS = 200
"""A bridge that still breaks after so many breaks, one after another, comes down."""

_PRECISION = 0.01
_LITTLE_BY_LITTLE = 1.05
"""Growth of a load factor in which a bridge cracks little by little."""

DIRECTIONS = TENSION, COMPRESSION, SHEAR, TORSION, BENDING, FORCE, BARS = (
    "tension",
    "compression",
    "shear",
    "torsion",
    "bending",
    "force",
    "bars",
)
"""Directions of load effects on a connection: `force` where one in any direction breaks it, `bars` where it cracked."""


@dataclass(frozen=True, slots=True, eq=False)
class Standing:
    """A bridge at rest."""

    held: np.ndarray  # (n,), shards that connections to a support hold
    loads: ConnectionLoads  # of the m connections, in the axes of the world; 0 for broken ones
    alone: np.ndarray  # (m,), utilisation of each connection by itself; nan for those that are gone
    together: np.ndarray  # (m,), utilisation of the sections of their members; nan as above
    sag_m: float  # largest downward displacement of a shard, below 0 where a larger one is upwards
    frequency_hz: float  # first natural frequency, without cracks
    cracked: np.ndarray  # (m,), connections that cracked and hold by their bars, of which both utilisations are then
    uncracked: Equilibrium  # as if nothing cracked
    bare_n: np.ndarray  # (g,), forces of bars that stand bare, above 0 in tension

    @property
    def used(self) -> np.ndarray:
        """Utilisation (m,): above 1 a connection breaks, as it and its section are overloaded."""
        return np.minimum(self.alone, self.together)


class StandingBridge:
    """Solves a model with elastic connections at rest, whatever of it is gone; calls `pause` again and again.

    Tendons are cut where they pass through connections that are gone, and wherever `cuts` says.
    """

    def __init__(
        self,
        model: Model,
        joints: Sequence[Joint],
        pause: Callable[[], None] = lambda: None,
        resting: RestingModel | None = None,
    ):
        self._resting = resting or RestingModel(model, joints)
        self.model, self._joints, self._pause = model, joints, pause
        self._masses = np.where(model.fixed, 0.0, model.masses_kg)
        self._inertias, self._held_motions = inertias_of(model), held_motions(model, joints)
        self._utilisations = Utilisations(model, joints)
        self._as_built: Standing | None = None
        self._factors: dict[tuple[bytes | tuple[CutTendon, ...], ...], float] = {}
        self._last_cracked: tuple[tuple[bytes | float | tuple[CutTendon, ...], ...], CrackedBridge] | None = None

    def tendons(self, intact: np.ndarray, cuts: Sequence[CutTendon] = ()) -> TendonForces | None:
        """Return the tendons with the connections that are `intact` (m,), after further cuts; None without any."""
        if self.model.tendons is None:
            return None
        forces = self.model.tendons.forces_of_shards(self.model.centres_m)
        forces.cut([*forces.passages.crossing(np.flatnonzero(~intact), np.zeros(0, int)), *cuts])
        return forces

    def rest(
        self,
        intact: np.ndarray,
        left: np.ndarray,
        loads: np.ndarray,
        factor: float = 1.0,
        *,
        every_section: bool = True,
        bare: BareBars | None = None,
        at_worst: bool = False,
        cuts: Sequence[CutTendon] = (),
    ) -> Standing:
        """Return the bridge at rest with the connections that are `intact` (m,), and `left` (m,) of their strength.

        Loads (6, n) are forces and moments on the shards, on top of their weight; all are times the load factor.
        Without `every_section`, only sections of connections that are overloaded by themselves are judged: no other
        breaks. Where bars cross what is overloaded, that cracks, if the bridge then stands. Where bars stand `bare`,
        all that is overloaded breaks or cracks; `at_worst` is as in `StandingBare`.
        """
        standing = self._elastic(intact, left, loads, factor, every_section=every_section, cuts=cuts)
        if bare is not None:
            on_bare = self._on_bare_bars(intact, left, bare, at_worst, cuts)
            on_bare.carry(factor, loads, self._pause)
            return self._on_bars(on_bare, left, standing)
        if self.model.crack_bars is None or not len(self._broken(standing, intact)):
            return standing
        cracked = self._cracked(intact, left, loads, factor, standing, cuts)
        return standing if cracked.fallen.any() else self._on_bars(cracked, left, standing)

    def unbroken(self, intact: np.ndarray) -> Standing:
        """Return the bridge under its weight, with the connections that are `intact` (m,), as if none broke.

        Sections are judged where a connection is overloaded by itself.
        """
        nothing = np.zeros((6, len(self.model.shards)))
        return self._elastic(intact, np.ones(len(intact)), nothing, 1.0, every_section=False)

    def _elastic(
        self,
        intact: np.ndarray,
        left: np.ndarray,
        loads: np.ndarray,
        factor: float,
        *,
        every_section: bool,
        cuts: Sequence[CutTendon] = (),
    ) -> Standing:
        """Return the bridge as if nothing cracked."""
        self._pause()
        model, rows = self.model, np.flatnonzero(intact)
        solution = (
            self._resting.rest
            if self._is_resting(intact, loads, factor, cuts)
            else at_rest(
                model.connections.only(intact),
                given(model.stiffness).only(rows),
                self._masses,
                self._inertias,
                model.centres_m,
                self._held_motions[:, rows],
                (0.0, 0.0, -factor * STANDARD_GRAVITY_M_S2),
                factor * loads,
                model.bearings.springs.among(intact) if model.bearings else None,
                self.tendons(intact, cuts),
            )
        )
        carried = np.zeros((6, len(intact)))
        carried[:, rows] = solution.loads
        of_connections = ConnectionLoads(carried[:3].T, carried[3:].T, model.connections.points)
        held = solution.held[:-1]
        parts = self.parts(intact)
        alone, together = self._utilisations.of(of_connections, intact, left, parts, every_section=every_section)
        return Standing(
            held=held,
            loads=of_connections,
            alone=alone,
            together=together,
            sag_m=deflection_m(model, solution),
            frequency_hz=solution.frequency_hz,
            cracked=np.zeros(len(intact), bool),
            uncracked=solution,
            bare_n=np.zeros(0),
        )

    def _is_resting(self, intact: np.ndarray, loads: np.ndarray, factor: float, cuts: Sequence[CutTendon]) -> bool:
        """Return whether it is as it was built, under nothing but its weight."""
        return bool(intact.all()) and factor == 1.0 and not loads.any() and not cuts

    def _cracked(
        self,
        intact: np.ndarray,
        left: np.ndarray,
        loads: np.ndarray,
        factor: float,
        elastic: Standing,
        cuts: Sequence[CutTendon],
    ) -> CrackedBridge:
        """Return a bridge whose concrete has cracked under loads; the last one is kept, as much cracking takes long."""
        if self._is_resting(intact, loads, factor, cuts) and (left == 1.0).all() and self.model.crack_bars is not None:
            return given(self._resting.cracked(self._pause))
        case = (intact.tobytes(), left.tobytes(), loads.tobytes(), factor, tuple(cuts))
        if self._last_cracked is None or self._last_cracked[0] != case:
            cracked = self._begun(intact, left, elastic, cuts)
            cracked.carry(factor, loads, self._pause)
            self._last_cracked = case, cracked
        return self._last_cracked[1]

    def _begun(
        self, intact: np.ndarray, left: np.ndarray, elastic: Standing, cuts: Sequence[CutTendon] = ()
    ) -> CrackedBridge:
        """Return a bridge whose concrete cracks under loads, before any."""
        return CrackedBridge(
            self.model,
            self._joints,
            self._utilisations,
            intact,
            left,
            elastic.uncracked,
            SteelBeside(tendons=self.tendons(intact, cuts)),
        )

    def _on_bare_bars(
        self, intact: np.ndarray, left: np.ndarray, bare: BareBars, at_worst: bool, cuts: Sequence[CutTendon] = ()
    ) -> CrackedBridge:
        """Return a bridge that stands as it was built, in the moment in which bars of it are bared."""
        if self._as_built is None:
            whole, nothing = np.ones(len(intact)), np.zeros((6, len(self.model.shards)))
            self._as_built = self._elastic(whole > 0.0, whole, nothing, 1.0, every_section=False)
        built = self._as_built.uncracked
        beside = SteelBeside(StandingBare(bare, at_worst), self.tendons(intact, cuts))
        return CrackedBridge(self.model, self._joints, self._utilisations, intact, left, built, beside)

    def _on_bars(self, cracked: CrackedBridge, left: np.ndarray, elastic: Standing) -> Standing:
        """Return a bridge that stands with cracks."""
        loads, intact = cracked.loads, cracked.intact
        parts = self.parts(cracked.holding)
        alone, together = self._utilisations.of(loads, intact, left, parts, every_section=True)
        used, has_bars = cracked.bars_used, cracked.cracked & np.isfinite(cracked.bars_used)
        alone[has_bars] = together[has_bars] = used[has_bars]
        return replace(
            elastic,
            held=cracked.held,
            loads=loads,
            alone=alone,
            together=together,
            sag_m=cracked.deflection_m,
            cracked=has_bars,
            bare_n=cracked.bare_n,
        )

    def comes_down(
        self,
        intact: np.ndarray,
        left: np.ndarray,
        loads: np.ndarray,
        factor: float,
        cuts: Sequence[CutTendon] = (),
    ) -> np.ndarray:
        """Return which shards (n,) come down at a load factor, as overloaded connections break one after another.

        Splinters that come loose do not count.
        """
        first = standing = self._elastic(intact, left, loads, factor, every_section=False, cuts=cuts)
        if self.model.crack_bars is not None:
            return self._cracked(intact, left, loads, factor, first, cuts).fallen
        intact, is_collapse = intact.copy(), False
        least = FALLEN_SHARE * self._masses[first.held].sum()
        rounds = 0
        while rounds < _MOST_ROUNDS:
            broken = self._broken(standing, intact)
            if not len(broken):
                return first.held & ~standing.held & is_collapse
            intact[broken] = False
            standing = self._elastic(intact, left, loads, factor, every_section=False, cuts=cuts)
            rounds += 1
            if not is_collapse and self._masses[first.held & ~standing.held].sum() > least:
                is_collapse, rounds = True, 0
        return first.held & ~standing.held if is_collapse else first.held

    def collapse_factor(
        self,
        intact: np.ndarray,
        left: np.ndarray,
        loads: np.ndarray,
        bare: BareBars | None = None,
        cuts: Sequence[CutTendon] = (),
    ) -> float:
        """Return the collapse load factor, within 1 %: ∞ above 64, nan where nothing is held.

        With bars, also if they stand `bare`, what cracked or yielded under a smaller factor stays so.
        """
        if bare is not None:
            return self._collapse_factor_of(self._on_bare_bars(intact, left, bare, False, cuts), loads)
        elastic = self._elastic(intact, left, loads, 1.0, every_section=False, cuts=cuts)
        if not elastic.held.any():
            return np.nan
        # A part that hangs free, or is gone, has no part in it.
        is_there = np.append(elastic.held | self.model.fixed, True)
        holds = intact & is_there[self.model.connections.pairs].all(axis=1)
        case = (holds.tobytes(), left[holds].tobytes(), loads[:, elastic.held].tobytes(), tuple(cuts))
        if case not in self._factors:
            self._factors[case] = self._factor_with(intact, left, loads, elastic, cuts)
        return self._factors[case]

    def _factor_with(
        self, intact: np.ndarray, left: np.ndarray, loads: np.ndarray, elastic: Standing, cuts: Sequence[CutTendon]
    ) -> float:
        if self.model.crack_bars is None:
            return _largest(lambda factor: not self.comes_down(intact, left, loads, factor).any())
        return self._collapse_factor_of(self._begun(intact, left, elastic, cuts), loads)

    def _collapse_factor_of(self, kept: CrackedBridge, loads: np.ndarray) -> float:
        stood = 0.0

        def stands(factor: float) -> bool:
            nonlocal kept, stood
            heavier = kept.copy()
            if not heavier.carries(factor, loads, self._pause):
                return False
            kept, stood = heavier, factor
            return True

        # What fell with many cracks at once may stand where it cracks little by little.
        factor = _largest(stands)
        return _largest(stands, stood, _LITTLE_BY_LITTLE) if stood and factor < np.inf else factor

    def governed_by(self, standing: Standing) -> np.ndarray:
        """Return which of `DIRECTIONS` has the largest utilisation of each connection (m,); empty where it is gone."""
        directions = np.full(len(standing.alone), "", dtype=object)
        there = np.isfinite(standing.alone) & self.model.breakable
        axes = self._utilisations.axes
        for number, judge in enumerate(self._utilisations.judges):
            rows = np.flatnonzero(there & (self.model.joint_of_connection == number))
            if judge is None:
                directions[rows] = FORCE
            elif len(rows):
                directions[rows] = _directions(judge, rows, standing.loads.in_sections(rows, axes[rows]))
        if self.model.bearings:
            pads = self.model.bearings.springs.rows
            directions[pads] = np.where(np.isfinite(standing.alone[pads]), FORCE, "")
        directions[standing.cracked] = BARS
        return directions

    def parts(self, holding: np.ndarray) -> np.ndarray:
        """Return which part each connection (m,) that holds belongs to; -1 for those that are gone."""
        return self._utilisations.parts(holding)

    def _broken(self, standing: Standing, intact: np.ndarray) -> np.ndarray:
        """Return the overloaded connections (k,), each the worst around."""
        return self._utilisations.worst(standing.alone, standing.together, intact)


def _largest(stands: Callable[[float], bool], low: float = 0.0, growth: float = 2.0) -> float:
    """Return the largest load factor under which a bridge stands, within 1 %; ∞ above 64.

    It stands under `low`, from which on the factor is looked for in steps of a growth.
    """
    high = low * growth or 1.0
    while stands(high):
        low, high = high, growth * high
        if high > LARGEST_FACTOR:
            return np.inf
    while high - low > _PRECISION * high:
        middle = (low + high) / 2.0
        if stands(middle):
            low = middle
        else:
            high = middle
    return (low + high) / 2.0


def _directions(judge: Overloads, rows: np.ndarray, carried: SectionForces) -> np.ndarray:
    """Return the direction with the largest utilisation of connections (r,) with a strength, each by itself."""
    nothing = {item.name: np.zeros_like(getattr(carried, item.name)) for item in fields(SectionForces)}
    used = [
        judge.of_forces(rows, SectionForces(**nothing | {name: getattr(carried, name)}))
        for name in ("axial_n", "shear_n", "torsion_nm", "bending_nm")
    ]
    names = np.array((TENSION, SHEAR, TORSION, BENDING))[np.argmax(used, axis=0)]
    return np.where((names == TENSION) & (carried.axial_n < 0.0), COMPRESSION, names)


def made_elastic(scenario: Scenario) -> Scenario:
    """Return a scenario with elastic connections; those that break by a force become as stiff as the others.

    Where all do, they are as stiff as reinforced concrete.
    """
    between = tuple(
        replace(table, breaking_force_n=None, breaking_force_kgf=None) for table in scenario.connections.between
    )
    changes: dict[str, Any] = {"stiffness": "elastic", "between": between}
    if scenario.connections.material is None and scenario.connections.method == "face":
        changes |= {"breaking_force_n": None, "breaking_force_kgf": None, "material": MATERIAL_OF_LARGE_MODELS}
    if (method := scenario.connections.method) != "face":
        raise ScenarioError(
            f'connections.method is "{method}": how the bridge stands can only be worked out with '
            f'method = "face", without search_radius_m, and material = "{MATERIAL_OF_LARGE_MODELS}" or another'
        )
    try:
        return replace(scenario, connections=replace(scenario.connections, **changes))
    except ScenarioError as error:
        raise ScenarioError(f"how a bridge rests is worked out with elastic connections, but {error}") from error


RESISTANCE = "resistance"
"""In place of one of `DIRECTIONS`: bending and axial force, by the resistance of a section with its bars."""

ALONG_SLAB = "links along the slab"
"""In place of one of these: shear between a girder and its slab, by what the links between them resist."""


@dataclass(frozen=True, slots=True, eq=False)
class MostUsed:
    """The section with bars, or the face elsewhere, with the largest utilisation.

    `governed_by` is `RESISTANCE`, `ALONG_SLAB` or one of `DIRECTIONS`, and `between` are the members on both sides,
    which may be one.
    """

    used: float
    governed_by: str
    between: tuple[str, ...]
    at_m: np.ndarray  # (3,)

    @property
    def words(self) -> str:
        """What the utilisation is a part of."""
        if self.governed_by == ALONG_SLAB:
            return "of what links carry along the slab"
        return "of the resistance in bending" if self.governed_by == RESISTANCE else "of the strength of a face"


def most_used_of(bridge: StandingBridge, sections: SectionsWithBars, standing: Standing) -> MostUsed | None:
    """Return what is used most; None where nothing is held.

    Faces within members with layers of bars are judged by their sections, faces of girders under slabs by their links:
    such a face cracks, and the bars hold.
    """
    model = bridge.model
    of_faces = np.where(sections.judged, np.nan, standing.used)
    uncracked = np.where(standing.cracked, np.nan, standing.used)
    section = sections.most_used(standing.loads, uncracked)
    face = int(np.nanargmax(of_faces)) if np.isfinite(of_faces).any() else None
    if section and (face is None or section.used >= of_faces[face]):
        governed_by = ALONG_SLAB if section.along_slab else RESISTANCE
        return MostUsed(section.used, governed_by, (model.members[section.member].name,), section.at_m)
    if face is None:
        return None
    return MostUsed(
        float(of_faces[face]), bridge.governed_by(standing)[face], model.between(face), model.connections.points[face]
    )
