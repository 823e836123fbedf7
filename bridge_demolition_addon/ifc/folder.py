"""The folder of an imported bridge: its scenario, a mesh for each element, and a table of the elements."""

from __future__ import annotations

import csv
import io
import math
import os
import re
import tempfile
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.units import mass_text, volume_text
from ..errors import GeometryError, IfcError, OutputError, ScenarioError
from ..model.bridge.member import Member
from ..model.bridge.mesh_files import exported
from ..model.bridge.preparation import prepared_members
from ..model.mesh_reading import read_mesh
from ..model.scenario.file import read_scenario
from ..model.toml_tables import tables_text
from ..system.disk import write_whole_text, writing
from .bars import notes_on_bars
from .bridge import MESH_FOLDER, ImportedBridge
from .outcome import ADDED, BAR, CONNECTION, LEFT_OUT, MEMBER, Outcome

SCENARIO_FILE = "scenario.toml"
ELEMENTS_FILE = "elements.csv"
REPORT_FILE = "import.txt"
LEFT_OUT_FOLDER = "left_out"

_NAME = "# "
"""What begins the line of a mesh that names its element."""

_SMALL_M3 = 0.1
_CUT_OFF = re.compile(r": ([0-9.e+-]+) m³ cut off,")

_COLUMNS = (
    *("element", "class", "global_id", "became", "name", "kind", "material", "density_kg_m3"),
    *("volume_m3", "mass_kg", "why"),
)


def folder_beside(path: Path) -> Path:
    """Return a new folder next to the IFC file."""
    folders = (path.with_name(f"{path.stem}_scenario{ending}") for ending in ("", *(f"_{n}" for n in range(2, 10_000))))
    return next(folder for folder in folders if not folder.exists())


def check_new(folder: Path) -> None:
    """Check that a folder does not exist, or is empty."""
    if folder.is_dir() and not any(folder.iterdir()):
        return
    if folder.exists() or folder.is_symlink():
        raise OutputError(f"{folder}: exists already; give another folder, or delete it")


def write_bridge(bridge: ImportedBridge, folder: Path) -> list[str]:
    """Write an imported bridge, whole or not at all, and return the lines of its report."""
    check_new(folder)
    with writing(folder), tempfile.TemporaryDirectory(dir=_existing(folder), prefix=".bda-import-") as name:
        # One folder deeper: `tempfile`'s is for its owner alone, and is deleted by it.
        whole = Path(name) / "bridge"
        (whole / MESH_FOLDER).mkdir(parents=True)
        for file, mesh in bridge.meshes.items():
            (whole / file).write_bytes(exported(mesh, ".obj"))
        _write_left_out(bridge.left_out, whole / LEFT_OUT_FOLDER)
        (whole / SCENARIO_FILE).write_text(tables_text(bridge.scenario, defaults=False), encoding="utf-8")
        lines = list(_report(bridge, *_as_read(whole, bridge)))
        write_whole_text(whole / ELEMENTS_FILE, _table(bridge), newline="")
        write_whole_text(whole / REPORT_FILE, "\n".join(lines) + "\n")
        folder.parent.mkdir(parents=True, exist_ok=True)
        if folder.is_dir():
            folder.rmdir()  # Windows moves nothing onto a folder
        os.replace(whole, folder)
    return lines


def _write_left_out(meshes: Mapping[str, TriangleMesh], folder: Path) -> None:
    """Write the meshes of elements that are left out, each with its name as a comment, if there are any."""
    if meshes:
        folder.mkdir()
    for number, (name, mesh) in enumerate(meshes.items(), start=1):
        content = f"{_NAME}{name}\n".encode() + exported(mesh, ".obj")
        (folder / f"{number:03d}.obj").write_bytes(content)


def read_left_out(folder: Path) -> dict[str, TriangleMesh]:
    """Return the meshes of the elements that an import into a folder left out, by their names."""
    meshes = {}
    for path in sorted((folder / LEFT_OUT_FOLDER).glob("*.obj")):
        with path.open(encoding="utf-8") as lines:
            name = next(lines).removeprefix(_NAME).strip()
        meshes[name] = read_mesh(path)
    return meshes


def _existing(folder: Path) -> Path:
    return next(parent for parent in folder.absolute().parents if parent.is_dir())


def _as_read(whole: Path, bridge: ImportedBridge) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return notes on what is cut off where members overlap, and on bars; refuses what `bda check` would refuse."""
    added = [outcome.part[0].name for outcome in bridge.outcomes if outcome.became == ADDED]
    try:
        scenario = read_scenario(whole / SCENARIO_FILE)
        prepared = prepared_members(scenario)
        return prepared.notes, tuple(notes_on_bars(scenario, prepared.members, added))
    except (GeometryError, ScenarioError) as error:
        text = str(error).removeprefix(f"{whole / SCENARIO_FILE}: ")
        for table in bridge.scenario.geometry:  # in a folder that is not kept
            text = text.replace(f"{whole / table.file}: ", "")
        raise IfcError(f"{text} Or leave it out by --without NAME") from error


def _report(bridge: ImportedBridge, cut_off: tuple[str, ...], on_bars: tuple[str, ...]) -> Iterator[str]:
    members = [outcome.member for outcome in bridge.outcomes if outcome.member]
    yield bridge.scenario.title
    yield ""
    yield "Members"
    for kind in sorted({member.kind for member in members}):
        of_kind = [member for member in members if member.kind == kind]
        yield _row(f"{len({member.name for member in of_kind})} {kind}", of_kind)
    yield _row("all", members)
    yield from _by_file(bridge.outcomes)
    if bridge.on_bars:
        yield ""
        yield "Bars of steel"
        yield from (f"  {line}" for line in bridge.on_bars)
    yield ""
    yield "Held and connected"
    connections = bridge.scenario.connections
    yield f"  {'strength of':<24}{connections.material}"
    added = [outcome.part[0].name for outcome in bridge.outcomes if outcome.became == ADDED]
    for support in bridge.scenario.supports:
        if support.member not in added:
            yield f"  {'held':<24}{support.member}{'' if support.face == 'all' else ', its underside'}"
    if added:
        yield f"  {'held':<24}{len(added)} supports that the file lacks: {added[0]}{' and so on' if added[1:] else ''}"
    for bearing in bridge.scenario.bearings:
        yield f"  {'bearing':<24}{' on '.join(bearing.members)}: {bearing.described}"
    for rule in connections.between:
        free = f", free: {', '.join(rule.free)}" if rule.free else ""
        connection = f"strength of {rule.material}" if rule.material else f"bearing{free}"
        yield f"  {'between':<24}{' and '.join(rule.members)}: {connection}"
    yield ""
    yield "Place"
    yield f"  {'ground':<24}at {bridge.ground_m:.3f} m in the file: {bridge.ground_source}"
    yield f"  {'site':<24}{_where(bridge)}"
    yield from _left_out(bridge.outcomes)
    notes = dict.fromkeys((*bridge.notes, *on_bars, *_reasons(bridge.outcomes), *_of_cutting(cut_off)))
    if notes:
        yield ""
        yield "To know"
        yield from (f"  {note}" for note in notes)


def _of_cutting(notes: Sequence[str]) -> Iterator[str]:
    """Yield notes on what is cut off where members overlap, small parts in one line."""
    small = 0
    for note in notes:
        found = _CUT_OFF.search(note)
        if found and float(found.group(1)) < _SMALL_M3:
            small += 1
        else:
            yield note
    if small:
        yield f"{small} members lose less than {_SMALL_M3:g} m³ each where they overlap with members before them"


def _by_file(outcomes: Sequence[Outcome]) -> Iterator[str]:
    """Yield volume and mass of the members whose program says them, with the program's values."""
    known = [outcome for outcome in outcomes if outcome.became in (MEMBER, BAR) and outcome.member]
    for word, text, of_file, of_member in (
        ("volume", volume_text, "file_volume_m3", "volume_m3"),
        ("mass", mass_text, "file_mass_kg", "mass_kg"),
    ):
        said = [outcome for outcome in known if getattr(outcome, of_file)]
        if said:
            total = math.fsum(getattr(outcome, of_file) for outcome in said)
            ours = math.fsum(getattr(outcome.part[0], of_member) for outcome in said)
            yield (
                f"  {word:<24}{text(total).strip()} by the file for {len(said)} elements, {text(ours).strip()} here, "
                f"{100.0 * (ours / total - 1.0):+.2f} %"
            )


def _where(bridge: ImportedBridge) -> str:
    site = bridge.scenario.site
    if site is None:
        return f"not known: {bridge.site_source}"
    degrees = f"{site.latitude_deg:.6f}°, {site.longitude_deg:.6f}°"
    return f"{degrees}, x axis {site.bearing_deg:.2f}° from north, {bridge.site_source}"


def _row(name: str, members: Sequence[Member]) -> str:
    volume_m3 = math.fsum(member.volume_m3 for member in members)
    mass_kg = math.fsum(member.mass_kg for member in members)
    return f"  {name:<23} {volume_text(volume_m3, width=9)} {mass_text(mass_kg, width=10)}"


def _left_out(outcomes: tuple[Outcome, ...]) -> Iterator[str]:
    left_out = [outcome for outcome in outcomes if outcome.became == "left out"]
    if left_out:
        yield ""
        yield "Left out"
    for (name, why), count in Counter((outcome.facts.classes[0], outcome.why) for outcome in left_out).items():
        yield f"  {f'{count} {name}':<23} {why}"


def _reasons(outcomes: tuple[Outcome, ...]) -> Iterator[str]:
    """Yield the notes on members and bearings, elements with the same note together."""
    elements: dict[str, list[str]] = {}
    for outcome in outcomes:
        notes = outcome.why.split("; ")
        for why in notes[1:] if outcome.became == CONNECTION else notes:
            if outcome.became != LEFT_OUT and why:
                elements.setdefault(why, []).append(outcome.facts.name)
    yield from _together(elements)


def _together(elements: Mapping[str, Sequence[str]]) -> Iterator[str]:
    """Yield notes, each behind the names of the elements that it is on."""
    for why, names in elements.items():
        more = f" and {len(names) - 3} more" if len(names) > 3 else ""
        yield f"{', '.join(names[:3])}{more}: {why}"


def _table(bridge: ImportedBridge) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_COLUMNS)
    for outcome in bridge.outcomes:
        facts = outcome.facts
        row = [facts.name, facts.classes[0], facts.global_id, outcome.became]
        if outcome.member is None:
            row += ["", "", "", "", "", ""]
        else:
            member, substance = outcome.part
            row += [member.name, member.kind, substance.name, f"{member.density_kg_m3:.6g}"]
            row += [f"{member.volume_m3:.6g}", f"{member.mass_kg:.6g}"]
        writer.writerow([*row, outcome.why])
    return text.getvalue()
