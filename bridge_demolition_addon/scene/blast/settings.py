"""Whether and how the charges of a scene go off, kept with the scene."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import bpy

from ...core.blast.explosion import BlastOptions
from ...core.blast.models import BlastModel
from ...core.blast.pulses import Loading
from ...core.scenario import BlastSettings

_PREFIX = "bda_blast_"


class Apply(StrEnum):
    """How blast loads reach the bodies."""

    FIELDS = "fields"
    """By one force-field empty per body, steady within a frame."""

    DIRECT = "direct"
    """As forces in Bullet, anew in every sub-step."""


@dataclass(frozen=True, slots=True)
class ExplosionSettings:
    """How the charges of a scene go off.

    Attributes
    ----------
    explosion
        Whether they do at all.
    apply
        How their loads reach the bodies.
    options
        How these are reckoned.
    """

    explosion: bool = False
    apply: Apply = Apply.FIELDS
    options: BlastOptions = BlastOptions()  # noqa: RUF009 - it is frozen


def explosion_settings(settings: BlastSettings) -> ExplosionSettings:
    """What a scenario says of it."""
    return ExplosionSettings(settings.explosion, Apply(settings.apply), settings.options)


def keep_explosion(scene: bpy.types.Scene, settings: ExplosionSettings) -> None:
    """Note it in the scene, which is saved with it."""
    options = settings.options
    values = {
        "explosion": settings.explosion,
        "apply": settings.apply.value,
        "start_s": options.start_s,
        "model": options.model.value,
        "loading": options.loading.value,
        "shielding": options.shielding,
        "constant_decay": -1.0 if options.constant_decay is None else options.constant_decay,
    }
    for name, value in values.items():
        scene[_PREFIX + name] = value


def explosion_of(scene: bpy.types.Scene) -> ExplosionSettings:
    """What was noted in a scene; in any other, that nothing goes off."""
    if _PREFIX + "explosion" not in scene:
        return ExplosionSettings()
    kept = {name: scene[_PREFIX + name] for name in ("start_s", "model", "loading", "shielding", "constant_decay")}
    options = BlastOptions(
        start_s=kept["start_s"],
        model=BlastModel(kept["model"]),
        loading=Loading(kept["loading"]),
        shielding=bool(kept["shielding"]),
        constant_decay=None if kept["constant_decay"] < 0.0 else kept["constant_decay"],
    )
    return ExplosionSettings(bool(scene[_PREFIX + "explosion"]), Apply(scene[_PREFIX + "apply"]), options)
