"""What connections are to the solver, by the settings that the user writes: type, springs, what breaks them, moduli."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

from ...engineering.elasticity.section_stiffness import ElasticModuli
from ...engineering.mechanics.joint import Joint
from ...engineering.mechanics.strength import NEWTON_PER_SQUARE_MILLIMETRE, SMEARED, Strength
from ..materials.materials import Material, moduli, strengths
from ..schema import expected, given
from .connections_between import ConnectionBetween

if TYPE_CHECKING:
    from .connections import ConnectionSettings


def joints_of_connections(
    settings: ConnectionSettings, materials: Sequence[Material] = (), *, have_bars: bool = False
) -> tuple[Joint, ...]:
    """Return the joint of connections that follow no rule, then that of each rule.

    In members that have bars, concrete has no steel that is smeared.
    """
    known = {name: strength.times(settings.strength_factor) for name, strength in strengths(materials).items()}
    _check_materials(settings, known)
    if have_bars:
        known |= {name: known[plain] for name, plain in SMEARED.items()}
    factor = settings.strength_factor
    own = Joint(
        settings.type,
        settings.free or (),
        settings.springs,
        _times(factor, settings.breaking_force_newton),
        known[settings.material] if settings.material else None,
        _moduli(settings, materials) if settings.is_elastic else None,
    )
    return (own, *(_joint_between(own, rule, factor, known, materials) for rule in settings.between))


def _check_materials(settings: ConnectionSettings, known: Collection[str]) -> None:
    for table in settings.tables:
        if table.material is not None and table.material not in known:
            raise table.unexpected("material", expected(table.__dataclass_fields__["material"]))


def _joint_between(
    own: Joint,
    rule: ConnectionBetween,
    factor: float,
    known: Mapping[str, Strength],
    materials: Sequence[Material],
) -> Joint:
    kind = rule.type or own.type
    free, springs = (rule.free or (), rule.springs) if rule.changes_joint else (own.free, own.springs)
    force, strength = _times(factor, rule.breaking_force_newton), known[rule.material] if rule.material else None
    if force is None and strength is None:
        force, strength = own.breaking_force_n, own.strength
    own_moduli = _moduli(rule, materials, own.moduli) if own.moduli else None
    return Joint(kind, free, springs, force, strength, own_moduli)


def _times(factor: float, force_n: float | None) -> float | None:
    return None if force_n is None else factor * force_n


def _moduli(
    settings: ConnectionSettings | ConnectionBetween,
    materials: Sequence[Material],
    others: ElasticModuli | None = None,
) -> ElasticModuli:
    """Return moduli that are given, or else those of a material, or else of the other connections."""
    young, poisson = settings.elastic_modulus_n_mm2, settings.poisson_ratio
    if young is not None and poisson is not None:
        return ElasticModuli(young * NEWTON_PER_SQUARE_MILLIMETRE, poisson)
    known = moduli(materials, settings.material) if settings.material else others
    return ElasticModuli(
        given(known).young_pa if young is None else young * NEWTON_PER_SQUARE_MILLIMETRE,
        given(known).poisson if poisson is None else poisson,
    )
