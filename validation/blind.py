# SPDX-License-Identifier: GPL-3.0-or-later
"""Forecasts that were kept before what was measured was opened, and what was measured.

A forecast is made once, by `scripts/blind_forecast NAME`, and committed before the outcome is opened: nothing makes it
again. The outcome is a file of its own, which names the commit of the forecast and what that had in it.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

KEPT = Path(__file__).resolve().parent.parent / "docs" / "data" / "blind"
"""Forecasts by the names of their cases, and outcomes beside them."""


@dataclass(frozen=True, slots=True)
class Foreseen:
    """A quantity that is foreseen, and the range that it is to be within."""

    quantity: str
    unit: str
    value: float
    low: float
    high: float

    def has(self, measured: float) -> bool:
        """Whether what was measured is within the range."""
        return self.low <= measured <= self.high


@dataclass(frozen=True, slots=True)
class BlindCase:
    """A case whose outcome was not known as its forecast was made.

    Attributes
    ----------
    name, title, asked : str
    known : str
        What was known of the set-up, and how blind the forecast is.
    assumed : str
        What was not known, and was assumed; and what the range stands for.
    source : str
    foresee : callable
        Makes the forecast in a folder, in which it leaves its scenarios.
    """

    name: str
    title: str
    asked: str
    known: str
    assumed: str
    source: str
    foresee: Callable[[Path], Sequence[Foreseen]]


@dataclass(frozen=True, slots=True)
class Forecast:
    """A forecast as it was kept: the day, the version of what decides runs, and what was foreseen."""

    made: str
    version: str
    foreseen: Sequence[Foreseen]


@dataclass(frozen=True, slots=True)
class Outcome:
    """What was measured, once it was opened.

    Attributes
    ----------
    opened, forecast_commit, forecast_sha256 : str
        The day, the commit that has the forecast and not the outcome, and the digest of the forecast's file.
    measured : sequence of float or None
        In the order of what was foreseen; None where the source does not say it.
    learned : str
        What hits and misses say.
    """

    opened: str
    forecast_commit: str
    forecast_sha256: str
    measured: Sequence[float | None]
    learned: str


def forecast_path(name: str) -> Path:
    """Where the forecast of a case is kept."""
    return KEPT / f"{name}.json"


def outcome_path(name: str) -> Path:
    """Where the outcome of a case is kept."""
    return KEPT / f"{name}_measured.json"


def digest(name: str) -> str:
    """Return the SHA-256 of a forecast's file, with one kind of line ends on all systems."""
    return hashlib.sha256(forecast_path(name).read_text(encoding="utf-8").encode()).hexdigest()


def keep(name: str, forecast: Forecast) -> None:
    """Keep a forecast.

    Raises
    ------
    FileExistsError
        Where one was kept before: it would no longer be blind.
    """
    KEPT.mkdir(parents=True, exist_ok=True)
    with forecast_path(name).open("x", encoding="utf-8", newline="\n") as file:
        file.write(json.dumps(asdict(forecast), indent=1, ensure_ascii=False) + "\n")


def kept_forecast(name: str) -> Forecast:
    """Return the forecast of a case as it was kept."""
    data = json.loads(forecast_path(name).read_text(encoding="utf-8"))
    return Forecast(data["made"], data["version"], [Foreseen(**row) for row in data["foreseen"]])


def kept_outcome(name: str) -> Outcome | None:
    """Return the outcome of a case; None before it was opened."""
    if not outcome_path(name).exists():
        return None
    return Outcome(**json.loads(outcome_path(name).read_text(encoding="utf-8")))
