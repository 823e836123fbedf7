"""Quantities in texts, put into another system of units: nowhere else do numbers of a report change their unit.

Texts of a report are made in SI units, and translated with their numbers in them. Then quantities are read there, a
number or several before the symbol of a unit, and put into the units that are asked for. Formulas, lines that go into
files, and the names that are the user's stay as they are.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from ...engineering.unit_systems import IMPERIAL, Conversion, Rounding, UnitSystem

_UNIT = "|".join(re.escape(unit) for unit in sorted(IMPERIAL, key=len, reverse=True))
_NUMBER = r"(?<![\w.,])[-\u2212]?\d+(?:(?: \d{3})+(?!\d))?(?:\.\d+)?(?:e[-+]?\d+)?"
_BETWEEN = r" (?:to|bis|a|à|至|and|und|y|et|和) | ?[×±\u2013] ?"
_ROW = rf"{_NUMBER}(?:(?:{_BETWEEN}){_NUMBER})*"
_PLACE = rf"[(\[]{_NUMBER}(?:, {_NUMBER})+[)\]]"
_QUANTITY = re.compile(rf"({_ROW}|{_PLACE}) ({_UNIT})(?![A-Za-z0-9_À-ɏ²³⁴·/^])")
_ONE_NUMBER = re.compile(_NUMBER)
_UNIT_OF_HEADING = re.compile(rf"(?<=[(\uff08])(?:{_UNIT})(?=[,)\uff09])|^(?:{_UNIT})$")

_LEFT_ALONE = re.compile(
    r"\d[\d.]* (?:mm|cm|m)/s \(R.*?\)\^-[\d.]+"  # a formula, whose constants go with its units
    r"|^\s*[a-z]\S*_\S* = .*"  # a line for a file, which takes SI units
)
_KEY = re.compile(r"\w_\w+ [(\uff08]")
"""A heading that is the key of a file, which takes SI units."""

_HOW_FAR = re.compile(
    r"exclusion|cordon|clear of people|kept clear|within|bridge's plan|outline|buffer|limit|throw|debris distance"
    r"|farthest|safe distance|safety distance|\bring\b|fragment|\bfly\b|largest distance",
    re.IGNORECASE,
)
"""Words of English texts that tell how far debris, fragments or a wave get, or how far people keep."""

_AT_LEAST = re.compile(rf"lie above ({_NUMBER}) m\b")
"""A distance that is exceeded: it is rounded down, as it was in metres."""

_DISTANCES = ("m", "km")


class ReportUnits:
    """The quantities of one report in a system of units.

    Parameters
    ----------
    system
        The system of units.
    kept
        Names of the user, in which no number is read.
    unit_name
        Returns what a language calls a unit, such as ``short tons``.
    """

    def __init__(
        self, system: UnitSystem, kept: Iterable[str] = (), unit_name: Callable[[str], str] = lambda unit: unit
    ) -> None:
        self.system = system
        self._unit_name = unit_name
        names = sorted({name for name in kept if _QUANTITY.search(name)}, key=len, reverse=True)
        alone = [re.escape(name) for name in names]
        self._alone = re.compile("|".join([*alone, _LEFT_ALONE.pattern]))

    @property
    def are_metric(self) -> bool:
        """Whether nothing is to be converted."""
        return self.system is UnitSystem.METRIC

    def text(self, text: str, english: str | None = None) -> str:
        """Return a text with its quantities in the system.

        Parameters
        ----------
        text
            The text, in any language.
        english
            What it and what stands around it say in English, by which distances to keep are rounded up; None where
            `text` is all of that.
        """
        if self.are_metric:
            return text
        about = text if english is None else english
        down = {match[1] for match in _AT_LEAST.finditer(about)}
        far = Rounding.UP if _HOW_FAR.search(about) else Rounding.NEAREST
        parts, end = [], 0
        for alone in self._alone.finditer(text):
            parts += [self._converted(text[end : alone.start()], far, down), alone[0]]
            end = alone.end()
        return "".join([*parts, self._converted(text[end:], far, down)])

    def conversion(self, heading: str) -> Conversion | None:
        """Return the conversion of the numbers below a heading with a unit; None where they stay as they are."""
        if self.are_metric or _KEY.search(heading):
            return None
        units = _UNIT_OF_HEADING.findall(heading)
        return IMPERIAL[units[-1]] if units else None

    def of_unit(self, unit: str) -> Conversion | None:
        """Return the conversion of a unit by its symbol; None where it is the same in the system."""
        return None if self.are_metric else IMPERIAL.get(unit)

    def heading(self, heading: str, english: str | None = None) -> str:
        """Return a heading, or the label of an axis, with its unit in the system, and quantities as in `text`."""
        text = self.text(heading, english)
        if self.conversion(heading) is None:
            return text
        return _UNIT_OF_HEADING.sub(lambda unit: self.unit(unit[0]), text)

    def unit(self, unit: str) -> str:
        """Return the symbol of a unit in the system, as the language has it; another text as it is."""
        conversion = self.of_unit(unit)
        return unit if conversion is None else self._unit_name(conversion.unit)

    def _converted(self, text: str, far: Rounding, down: set[str]) -> str:
        def quantity(match: re.Match[str]) -> str:
            conversion = IMPERIAL[match[2]]
            rounding = far if match[2] in _DISTANCES else Rounding.NEAREST
            numbers = _ONE_NUMBER.sub(
                lambda number: _number(conversion, number[0], Rounding.DOWN if number[0] in down else rounding),
                match[1],
            )
            return f"{numbers} {self._unit_name(conversion.unit)}"

        return _QUANTITY.sub(quantity, text)


def rounding_of(conversion: Conversion, english: str) -> Rounding:
    """Return to which side numbers of a column or an axis are rounded, by what it says in English."""
    is_distance = any(IMPERIAL[unit] is conversion for unit in _DISTANCES)
    return Rounding.UP if is_distance and _HOW_FAR.search(english) else Rounding.NEAREST


def _number(conversion: Conversion, text: str, rounding: Rounding) -> str:
    return conversion.number(text.replace("\u2212", "-").replace(" ", ""), rounding)


IN_METRIC = ReportUnits(UnitSystem.METRIC)
"""Leaves all quantities as they are."""
