"""Whether the values of connections fit together."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...engineering.elasticity.steel_bars import MODULUS_PA, USUAL_STEEL
from ...engineering.mechanics.strength import MATERIALS, NEWTON_PER_SQUARE_MILLIMETRE
from ...errors import ScenarioError
from ..schema import check_exactly_one, expected
from .connections_between import ConnectionBetween
from .joint_settings import ELASTIC_TYPES, STEEL_KEYS, STRENGTH_KEYS

if TYPE_CHECKING:
    from .connections import ConnectionSettings

_BY_STRESS = 'with stiffness "elastic"; elastic connections break by stress, not by one force'


def check_connections(settings: ConnectionSettings) -> None:
    """Check the values of connections against each other.

    Raises
    ------
    ScenarioError
        Where they do not fit, with the key and what is expected.
    """
    if settings.has_strength:
        check_exactly_one(settings, *STRENGTH_KEYS)
    for table in settings.tables:
        _check_material(settings, table)
        if not isinstance(table, ConnectionBetween) or table.changes_joint:
            table.check_type(table.type or settings.type)
    _check_ductility(settings)
    _check_steel(settings)
    if settings.warm_up_damping > 0.0 and settings.warm_up_s == 0.0:
        raise settings.unexpected("warm_up_damping", "0 where connections.warm_up_s is 0")
    _check_elastic(settings)
    _check_method(settings, "search_radius_m", "a number above 0 (m)", ("vertex", "centre"))
    _check_method(settings, "neighbours", "a whole number of at least 1", ("nearest",))


def _check_material(settings: ConnectionSettings, table: ConnectionSettings | ConnectionBetween) -> None:
    """Check that a material is given only where connections have an area."""
    if table.material is None or settings.method == "face":
        return
    wanted = f'method "face" with it, found "{settings.method}"'
    if table.material not in MATERIALS:
        wanted += f", and {expected(table.__dataclass_fields__['material'])}"
    raise table.unexpected("material", wanted)


def _check_ductility(settings: ConnectionSettings) -> None:
    """Check that smeared reinforcement has concrete around it, and an elongation."""
    if settings.ductile_share == 0.0:
        return
    if settings.material is None:
        raise settings.unexpected("ductile_share", "0 where connections.material is not given")
    if settings.ductile_elongation_m is None:
        wanted = "a number above 0 (m) with a connections.ductile_share above 0"
        raise settings.unexpected("ductile_elongation_m", wanted)


def _check_steel(settings: ConnectionSettings) -> None:
    """Check that the steel is described only where it counts, and yields before it ruptures."""
    for name in STEEL_KEYS:
        if getattr(settings, name) is not None and settings.stiffness == "rigid":
            wanted = 'none but with connections.stiffness "elastic"'
            raise settings.unexpected(name, wanted)
    is_given = settings.ductile_rupture_strain is not None
    rupture = USUAL_STEEL.rupture_strain if settings.ductile_rupture_strain is None else settings.ductile_rupture_strain
    yield_pa = USUAL_STEEL.yield_pa
    if settings.ductile_yield_n_mm2 is not None:
        yield_pa = settings.ductile_yield_n_mm2 * NEWTON_PER_SQUARE_MILLIMETRE
    if rupture <= yield_pa / MODULUS_PA:
        wanted = f"less: by 200 000 N/mm² it would be a strain above that at rupture, {rupture:g}"
        if is_given:
            wanted = f"more than {yield_pa / MODULUS_PA:.3g}, the strain at which the reinforcement yields"
        raise settings.unexpected("ductile_rupture_strain" if is_given else "ductile_yield_n_mm2", wanted)


def _check_elastic(settings: ConnectionSettings) -> None:
    """Check that keys of elastic connections go with them, and that none is missing."""
    if settings.stiffness is None:
        return
    if not settings.is_elastic:
        for table in settings.tables:
            for name in ("elastic_modulus_n_mm2", "poisson_ratio", "damping_ratio"):
                if getattr(table, name, None) is not None:
                    raise table.unexpected(name, 'none where connections.stiffness is "rigid"')
        return
    if settings.method != "face":
        raise settings.unexpected("method", '"face" with stiffness "elastic", which takes the area of shared faces')
    if settings.material is None and settings.has_strength:
        raise ScenarioError(f"connections.material is missing: expected it {_BY_STRESS}")
    for table in settings.tables:
        kind = table.type or settings.type
        if kind not in ELASTIC_TYPES and not getattr(table, "none", False):
            raise table.unexpected("type", f'one of {", ".join(ELASTIC_TYPES)} with stiffness "elastic"')
        if table is not settings and table.breaking_force_newton is not None:
            raise ScenarioError(f"{table.table} has a breaking force: expected a material {_BY_STRESS}")


def _check_method(settings: ConnectionSettings, name: str, wanted: str, methods: tuple[str, ...]) -> None:
    is_given, is_needed = getattr(settings, name) is not None, settings.method in methods
    if is_given != is_needed:
        raise settings.unexpected(name, f'{wanted if is_needed else "none"} with method "{settings.method}"')
