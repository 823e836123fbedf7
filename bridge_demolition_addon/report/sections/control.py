"""Document control: what identifies a report, and who prepared, checked and approved it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...model.scenario import ReportSettings, Scenario
from ...model.scenario.site import Site
from ...texts import Text, joined
from ...version import VERSION
from ..document.blocks import Column, Control, DataTable

_SHORT = 8
"""Digits of a digest that are shown, as the console shows them."""

_BLANK = "_" * 24
"""A line to write on."""

_PAIRS = (Column("", "fact"), Column("", "value"), Column("", "second_fact"), Column("", "second_value"))
_SIGNED = (Column("", "role"), Column("Name", "name"), Column("Date", "date"), Column("Signature", "signature"))


def document_control(scenario: Scenario | None, fingerprint: Mapping[str, str] | None = None) -> Control:
    """Return what identifies a report: what its scenario says, and the fingerprint of a run or code of its program."""
    settings = scenario.report if scenario else ReportSettings()
    facts = list(_facts(settings, scenario.site if scenario else None))
    if len(facts) % 2:
        facts.append(("", ""))
    rows = [(*first, *second) for first, second in zip(facts[::2], facts[1::2], strict=True)]
    cover = (DataTable("", "Document", _PAIRS, rows),) if rows else ()
    return Control(cover, (_signatures(settings),), _foot(settings, fingerprint or {}), settings.author or "")


def _facts(settings: ReportSettings, site: Site | None) -> Iterator[tuple[str, str]]:
    """Yield what is given, by its name; coordinates only next to it."""
    given = (
        (Text("Project"), settings.project),
        (Text("Number"), settings.document_number),
        (Text("Client"), settings.client),
        (Text("Site"), settings.site),
        (Text("Coordinates"), _coordinates(site)),
        (Text("Date"), settings.date),
        (Text("Revision"), settings.revision),
        (Text("Changed in this revision"), settings.changed),
    )
    if any(value for _, value in given if value != _coordinates(site)):
        yield from ((name, value) for name, value in given if value)


def _coordinates(site: Site | None) -> str:
    """Return where the origin lies, in degrees of WGS 84 to a metre; empty without a site."""
    if site is None:
        return ""
    return Text("{} {}, WGS 84", f"{site.latitude_deg:+.5f}°", f"{site.longitude_deg:+.5f}°")


def _signatures(settings: ReportSettings) -> DataTable:
    people = (
        (Text("Prepared by"), settings.author),
        (Text("Checked by"), settings.checked_by),
        (Text("Approved by"), settings.approved_by),
    )
    rows = [(role, name or _BLANK, _BLANK, _BLANK) for role, name in people]
    return DataTable("", "Signatures", _SIGNED, rows)


def _foot(settings: ReportSettings, fingerprint: Mapping[str, str]) -> str:
    """Return number and revision, program, and digests of a run, as the console gives them."""
    parts: list[str] = [Text("No. {}", settings.document_number)] if settings.document_number else []
    parts += [Text("revision {}", settings.revision)] if settings.revision else []
    code = fingerprint.get("program")
    parts.append(Text("program {}, code {}", VERSION, code) if code else Text("program {}", VERSION))
    if "built" in fingerprint:
        parts.append(Text("built {}", fingerprint["built"][:_SHORT]))
    if "result" in fingerprint:
        parts.append(Text("result {}", fingerprint["result"][:_SHORT]))
    return joined("{}; {}", parts)
