"""Slips in files of TOML that people make who do not know it: what is meant, and the text without them."""

from __future__ import annotations

import re
import tomllib
import unicodedata
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..errors import Faults, ScenarioError

_MOST_SLIPS = 50
"""So many slips in one file are shown at once."""

_LONGEST_SHOWN = 80

_KEY = r"^(\s*[\w.\"'-]+\s*=\s*)"
_NUMBER = r"[-+]?\d[\d_]*(?:\.\d+)?(?:[eE][-+]?\d+)?"

_DRIVE = re.compile(_KEY + r'"([A-Za-z]:\\(?!\\)[^"]*)"\s*(?:#.*)?$', flags=re.MULTILINE)
r"""A path of Windows in double quotes. Some are valid TOML: ``"C:\new"`` has an end of line in it."""

_BACKSLASHES = "has backslashes within double quotation marks"

_LINE = re.compile(r"\(at line (\d+), column \d+\)")


_DOUBLE, _SINGLE = "\u201c\u201d\u201e\u201f\u00ab\u00bb\u2033", "\u2018\u2019\u201a\u201b"
"""Quotation marks that programs for letters put in place of straight ones."""


@dataclass(frozen=True, slots=True)
class _Slip:
    pattern: re.Pattern[str]  # of a whole line, without a comment at its end
    reason: str
    meant: Callable[[re.Match[str]], str]  # the line as it was meant
    advice: str = ""  # where the line as it was meant would be bad advice


def _slip(pattern: str, reason: str, meant: Callable[[re.Match[str]], str] | str, advice: str = "") -> _Slip:
    line = meant if callable(meant) else lambda match: match.expand(str(meant))
    return _Slip(re.compile(pattern), reason, line, advice)


def _straight(match: re.Match[str]) -> str:
    return re.sub(f"[{_SINGLE}]", "'", re.sub(f"[{_DOUBLE}]", '"', match.string))


def _as_seen(match: re.Match[str]) -> str:
    """Return a line with usual spaces and digits in place of other scripts' signs, and without what is not seen."""
    usual = unicodedata.normalize("NFKC", match.string)
    return "".join(letter for letter in usual if unicodedata.category(letter) != "Cf")


def _with_slashes(match: re.Match[str]) -> str:
    return match.string.replace("\\", "/")


def _with_commas(match: re.Match[str]) -> str:
    return match[1] + match[2].replace(",", ".").replace(";", ",")


def _without_gaps(match: re.Match[str]) -> str:
    return match[1] + re.sub(r"\D", "", match[2])


def _switched(match: re.Match[str]) -> str:
    return match[1] + ("true" if match[2].lower() in ("true", "yes", "on") else "false")


def _closed(match: re.Match[str]) -> str:
    return f"{match[1]}{match[2]}{match[3]}{']' * len(match[2])}"


_MOST_DIGITS = 300
"""Of a number; the largest of double precision has 309."""

_UNSEEN = "\u00a0\u00ad\u2000-\u200f\u2028-\u202f\u205f-\u206f\u3000\ufeff\uff01-\uff5e"
"""Spaces that are none, letters that are not seen, and those of full width."""

_SLIPS = (
    _slip(f".*[{_UNSEEN}]", "has spaces, digits or letters that only look like usual ones", _as_seen),
    _slip(f".*[{_DOUBLE}{_SINGLE}]", "has typographic quotation marks", _straight),
    _slip(r'^.*"[^"]*\\[^"]*"', _BACKSLASHES, _with_slashes),
    _slip(_KEY + r"([-+]?\d+),(\d+)$", "has a decimal comma", r"\1\2.\3"),
    _slip(_KEY + r"(\[.*\d;\s*[-+\d].*\])$", "has semicolons between its numbers", _with_commas),
    _slip(_KEY + rf"(\d{{1,3}}(?:[ '{_SINGLE}]\d{{3}})+)$", "has gaps in its number", _without_gaps),
    _slip(_KEY + r"([-+]?)(\.\d+)$", "has a number without a digit before its point", r"\g<1>\g<2>0\3"),
    _slip(_KEY + r"([-+]?\d+)\.$", "has a number without a digit after its point", r"\1\2.0"),
    _slip(_KEY + r"0+(\d[\d.]*)$", "has a number that begins with 0", r"\1\2"),
    _slip(
        _KEY + rf"({_NUMBER})\s*([^\W\d_eE]|[°%]).*$",
        "has a unit",
        r"\1\2",
        "write the number alone, in the unit that the name of the key ends in",
    ),
    _slip(_KEY + r"(True|False|TRUE|FALSE|yes|no|Yes|No|on|off)$", "is no true or false", _switched),
    _slip(_KEY + r"([^\W\d_][^\"'\[\]{}=]*)$", "is a text without quotation marks", r'\1"\2"'),
    _slip(_KEY + r'"([^"]*)$', "has a text without an end", r'\1"\2"'),
    _slip(r"^(\s*)([A-Za-z][\w.-]*)\s*:\s*(.+)$", "has a colon", r"\1\2 = \3"),
    _slip(r"^(\s*)(\[\[?)([\w.-]+)\]?$", "has a heading without an end", _closed),
    _slip(r"^(\s*)(?://|;)(.*)$", "is no TOML, where a comment begins with #", r"\1#\2"),
)
"""The first that fits a line explains it."""


def parsed(text: str, faults: Faults) -> dict[str, Any]:
    """Return the content of a text in TOML; note slips, and go on with what was meant.

    Raise `ScenarioError` where it is not known what was meant, with the slips before that.
    """
    slips: list[tuple[int, str]] = []
    text = _without_drives(text.replace("\r\n", "\n").replace("\r", "\n"), slips)
    for _ in range(_MOST_SLIPS):
        try:
            document = tomllib.loads(text)
        except RecursionError as error:
            raise ScenarioError("not a TOML file: it has brackets in brackets, hundreds deep") from error
        except ValueError as error:
            _check_digits(text)
            text = _mended(text, error, slips)
        else:
            faults.found += _in_order(slips)
            return document
    raise ScenarioError(*_in_order(slips))


def _check_digits(text: str) -> None:
    """Refuse numbers of more digits than Python reads, which has no line of them."""
    if long := re.search(rf"[\d_]{{{_MOST_DIGITS + 1},}}", text):
        number = text.count("\n", 0, long.start()) + 1
        raise ScenarioError(
            f"line {number}: has a number of {len(long[0])} digits: expected one of up to {_MOST_DIGITS}"
        )


def _in_order(slips: list[tuple[int, str]]) -> list[str]:
    return [f"line {number}: {sentence}" for number, sentence in sorted(slips)]


def _without_drives(text: str, slips: list[tuple[int, str]]) -> str:
    for match in _DRIVE.finditer(text):
        number = text.count("\n", 0, match.start()) + 1
        slips.append(
            (
                number,
                _sentence(match[0], _BACKSLASHES, f"write {_shortened(_slashed(match))}"),
            )
        )
    return _DRIVE.sub(_slashed, text)


def _slashed(match: re.Match[str]) -> str:
    return f'{match[1]}"{match[2]}"'.replace("\\", "/")


def _mended(text: str, error: ValueError, slips: list[tuple[int, str]]) -> str:
    """Return the text without the slip that an error of tomllib is about, and note it; raise one that is unknown."""
    lines, where = text.split("\n"), _LINE.search(str(error))
    if where is None and "at end of document" not in str(error):
        raise ScenarioError(*_in_order(slips), f"not a TOML file: {error}") from error
    number = int(where[1]) if where else len(text.rstrip().split("\n"))
    line = lines[number - 1]
    if "twice" in str(error) and line.strip().startswith("["):
        slips.append((number, _second_heading(line.strip().strip("[] "))))
        raise ScenarioError(*_in_order(slips)) from error
    if "overwrite a value" in str(error):
        slips.append((number, _sentence(line, "gives a key of its table a second time", "leave one of them out")))
        return "\n".join([*lines[: number - 1], "", *lines[number:]])
    bare = _without_comment(line)
    for slip in _SLIPS:
        if (match := slip.pattern.match(bare)) and (meant := slip.meant(match)) != bare:
            slips.append((number, _sentence(bare, slip.reason, slip.advice or f"write {_shortened(meant)}")))
            return "\n".join([*lines[: number - 1], meant, *lines[number:]])
    shown = f": {_shortened(line)}" if line.strip() else ""
    raise ScenarioError(*_in_order(slips), f"not a TOML file: {error}{shown}") from error


def _second_heading(name: str) -> str:
    return (
        f"[{name}] is there a second time: put all of its keys under the first, or write [[{name}]] for each where "
        "there may be several"
    )


def _sentence(line: str, reason: str, advice: str) -> str:
    return f"{_shortened(line)} {reason}: {advice}"


def _without_comment(line: str) -> str:
    """Return a line without a comment at its end; a # within quotation marks begins none."""
    return re.sub(
        rf"""^((?:[^#"'{_DOUBLE}]|"[^"]*"|'[^']*'|[{_DOUBLE}][^"{_DOUBLE}]*["{_DOUBLE}])*)#.*$""", r"\1", line
    ).rstrip()


def _shortened(line: str) -> str:
    line = " ".join(line.split())
    return line if len(line) <= _LONGEST_SHOWN else line[:_LONGEST_SHOWN] + "…"
