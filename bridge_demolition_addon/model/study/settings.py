"""The tables of a study file, as checked values."""

from dataclasses import dataclass, fields
from typing import ClassVar

from .. import schema
from ..schema import LARGEST_INTEGER, Scalar, Table, given
from ..toml_tables import tables_text
from .criteria import Criterion
from .distributions import Choice, Distribution, Lognormal, Normal, Triangular, Uniform

_NEEDED = {
    "normal": ("mean", "deviation"),
    "lognormal": ("median", "variation"),
    "uniform": ("lowest", "highest"),
    "triangular": ("lowest", "most_likely", "highest"),
    "choice": ("values",),
}
"""Keys that a distribution needs."""

_TAKEN = _NEEDED | {name: (*_NEEDED[name], "lowest", "highest") for name in ("normal", "lognormal")}
"""Keys that a distribution may have."""

KEPT = ("outcome", "logs", "all")

RUNOUT_FACTOR = 1.82
"""What brings the shortest of the columns of loose blocks to the measured runout, rounded up: 1 / 0.55."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Vary(Table):
    """A key of the scenario whose value is sampled for each run, independently of all others. `scenario.seed`, which
    cuts the shards, always varies and needs no such table.
    """

    table: ClassVar[str] = "vary"

    key: str = schema.key(
        "Which key, with its table: `ball.drop_height_m`. In lists, a name or a number from 1 says which: "
        '`charges."mid pier".mass_kg`, `removals.2.time_s`, `ball.target_m.1`. Without it, the key of all tables of '
        "the list is sampled, of each for itself: `charges.delay_ms`."
    )
    distribution: str = schema.key("How it scatters.", choices=tuple(_NEEDED))
    mean: float | None = schema.key("Mean of a `normal` distribution.", default=None)
    deviation: float | None = schema.key("Standard deviation of a `normal` distribution.", default=None, above=0)
    median: float | None = schema.key("Median of a `lognormal` distribution.", default=None, above=0)
    variation: float | None = schema.key(
        "Coefficient of variation of a `lognormal` distribution: standard deviation by mean.",
        default=None,
        above=0,
        at_most=10,
    )
    lowest: float | None = schema.key(
        "Lowest value of a `uniform` or `triangular` distribution; of a `normal` or `lognormal` one, which is cut off "
        "there, if it is to have one.",
        default=None,
    )
    most_likely: float | None = schema.key("Where the density of a `triangular` distribution is highest.", default=None)
    highest: float | None = schema.key("Highest value, as with `lowest`.", default=None)
    values: tuple[Scalar, ...] | None = schema.key("Values of a `choice`, all equally likely.", default=None)
    factor: bool = schema.key(
        "Whether a factor on the scenario's own value is sampled, instead of a value in the key's unit.",
        default=False,
    )

    @property
    def sampled_from(self) -> Distribution:
        """Return the distribution."""
        ends = {name: getattr(self, name) for name in ("lowest", "highest") if getattr(self, name) is not None}
        match self.distribution:
            case "normal":
                return Normal(given(self.mean), given(self.deviation), **ends)
            case "lognormal":
                return Lognormal(given(self.median), given(self.variation), **ends)
            case "uniform":
                return Uniform(given(self.lowest), given(self.highest))
            case "triangular":
                return Triangular(given(self.lowest), given(self.most_likely), given(self.highest))
            case _:
                return Choice(given(self.values))

    def _check_together(self) -> None:
        for name in ("mean", "deviation", "median", "variation", "lowest", "most_likely", "highest", "values"):
            is_given = getattr(self, name) is not None
            if is_given and name not in _TAKEN[self.distribution]:
                raise self.unexpected(name, f'none with distribution "{self.distribution}"')
            if not is_given and name in _NEEDED[self.distribution]:
                raise self.unexpected(name, f'it with distribution "{self.distribution}"')
        self._check_order()
        if self.factor and self.values and not all(type(value) in (int, float) for value in self.values):
            raise self.unexpected("factor", "false where values are not numbers")
        _ = self.sampled_from  # refuses ends that leave nothing

    def _check_order(self) -> None:
        if self.lowest is not None and self.highest is not None and not self.lowest < self.highest:
            raise self.unexpected("highest", f"more than vary.lowest, {self.lowest:g}")
        if self.most_likely is not None and not given(self.lowest) <= self.most_likely <= given(self.highest):
            raise self.unexpected("most_likely", f"a number from vary.lowest to vary.highest, {self.highest:g}")
        if self.distribution == "lognormal" and self.lowest is not None and self.lowest < 0.0:
            raise self.unexpected("lowest", "at least 0 with a lognormal distribution")
        if self.distribution == "lognormal" and self.highest is not None and self.highest <= 0.0:
            raise self.unexpected("highest", "more than 0 with a lognormal distribution")


@dataclass(frozen=True, slots=True, kw_only=True)
class EnsembleSettings(Table):
    """What studies, searches and optimisations share."""

    table: ClassVar[str] = "ensemble"

    raised_later: ClassVar[tuple[str, ...]] = ()
    """Keys that count runs. They may be raised in a folder that was begun: all runs that are done stay."""

    scenario: str = schema.key("Path of the scenario file, from the folder of this file.")
    seed: int = schema.key("Start of the random numbers.", default=0, at_least=0, at_most=LARGEST_INTEGER)
    least_mass_kg: float = schema.key(
        "Lightest shard that is a hazard: the debris distance does not count lighter ones.",
        default=0.0,
        unit="kg",
        at_least=0,
        label="Ignore Pieces Below",
    )
    time_limit_s: float | None = schema.key(
        "Time after which a run that hangs is ended. It counts as a run of unlimited debris distance that met no "
        "criterion. By default none.",
        default=None,
        unit="s",
        above=0,
    )
    memory_limit_mb: float | None = schema.key(
        "Memory of a run's process above which it is ended, on Linux. The run counts as with `time_limit_s`. By "
        "default none.",
        default=None,
        unit="MB",
        above=0,
    )
    keep: str = schema.key(
        "What is kept of each run: its `outcome`, its `logs` as well, or `all` that `bda run` keeps.",
        default="outcome",
        choices=KEPT,
        label="What to Keep",
    )
    vary: tuple[Vary, ...] = ()
    criteria: tuple[Criterion, ...] = ()

    @property
    def shared_text(self) -> str:
        """What all kinds share, in TOML."""
        shared = {item.name: getattr(self, item.name) for item in fields(EnsembleSettings)}
        return tables_text(EnsembleSettings(**shared))


@dataclass(frozen=True, slots=True, kw_only=True)
class StudySettings(EnsembleSettings):
    """What is run, how often, and which limits are stated."""

    table: ClassVar[str] = "study"
    raised_later: ClassVar[tuple[str, ...]] = ("runs",)

    runs: int = schema.key(
        "Number of runs. Fix it beforehand: a limit that is looked at after every run, until it pleases, does not "
        "have its confidence.",
        default=93,
        at_least=1,
        at_most=10_000_000,
    )
    quantile: float = schema.key(
        "Part of all runs that the limit is for.",
        default=0.95,
        at_least=0.5,
        at_most=0.9999,
        label="Share of Runs Within",
    )
    confidence: float = schema.key(
        "Probability with which the limit holds for that part.",
        default=0.95,
        at_least=0.5,
        at_most=0.9999,
        label="Certainty of the Limit",
    )
    rank: int = schema.key(
        "Which of the largest debris distances is the limit, counted from the largest and fixed beforehand: with 2 it "
        "scatters less than with 1, but needs more runs.",
        default=2,
        at_least=1,
        at_most=1000,
        label="Limit Is the Nth Largest",
    )
    runout_factor: float = schema.key(
        "Factor on the limit, before the buffer is added: columns of loose blocks run out 0.55 to 0.73 times as far in "
        "the model as measured ones of grains. By default what brings the shortest of them to the measured distance; "
        "with 1 the limit is that of the runs.",
        default=RUNOUT_FACTOR,
        at_least=1,
        at_most=10,
        label="Factor for Runout",
    )
