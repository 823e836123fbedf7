# SPDX-License-Identifier: GPL-3.0-or-later
"""A bridge from IFC: its elements listed and corrected, an import that Esc stops, one that is built, and one undone."""

import shutil
import sys
import time

from file_browser import choose_file
from habits import undo
from panels import Panels
from person import Person, Steps
from traces import CHECKOUT, module

FILE = CHECKOUT / "tests" / "foreign" / "files" / "v440_tekla_modell.ifc"
LONGEST_STEP_S = 2.0
"""How long Blender may stand still while a file is imported, on a machine that has other work."""


def steps(person: Person) -> Steps:
    sys.path.append(str(person.folder / "libraries"))  # where Bonsai would have brought IfcOpenShell
    path = person.folder / FILE.name
    shutil.copyfile(FILE, path)
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from panels.show_only("Scenario")
    yield from person.click("bda.look_into_ifc")
    yield from choose_file(person, path)
    settings = person.scene.bda
    yield from person.wait_for("the elements are listed", lambda: len(settings.ifc_elements) == 28, 120.0)
    person.expect_reports("and it is said how many become members", "28 elements")
    yield from person.scroll_to_top()
    yield from person.picture("listed")
    yield from correct(person)
    yield from stop(person)
    yield from import_listed(person)
    yield from person.click("bda.build_scenario")
    yield from person.wait_for("it is built", lambda: person.scene.rigidbody_world is not None, 300.0)
    yield from person.picture("built")
    person.take_reports()
    yield from import_at_once(person, path)


def correct(person: Person) -> Steps:
    """Leave all parapets out: one in its row, the other by Same for All of This Name."""
    settings = person.scene.bda
    rows = [row for row, element in enumerate(settings.ifc_elements) if element.kind == "parapet"]
    person.expect("edge beams are parapets", len(rows), 2)
    settings.ifc_element_index = rows[0]
    settings.ifc_elements[rows[0]].kind = "left out"
    yield 0.5
    yield from person.click("bda.ifc_alike")
    yield 0.5
    person.expect("both are left out", {settings.ifc_elements[row].kind for row in rows}, {"left out"})
    person.expect_reports("and it is said", "2 elements are left out now")
    yield from person.picture("corrected")


def stop(person: Person) -> Steps:
    """Begin, look for how long Blender stands still, and press Esc before it is done: nothing is left."""
    progress = module("ui.task_progress").going_on
    yield from person.click("bda.import_ifc_elements")
    yield from person.wait_for("an import begins", lambda: progress() is not None, 20.0)
    longest, looked = 0.0, time.monotonic()
    for _ in range(40):
        yield 0.05
        longest, looked = max(longest, time.monotonic() - looked), time.monotonic()
        if progress() is None:
            break
    person.note(f"Blender stood still for {longest:.1f} s at most", "" if longest < LONGEST_STEP_S else "too long")
    yield from person.picture("being_imported")
    yield from person.move_to_view()
    yield from person.press("ESC")
    yield from person.wait_for("Esc stops it", lambda: progress() is None, 10.0)
    person.expect("no folder is left", [kept.name for kept in person.folder.glob("*_scenario*")], [])
    person.expect("and nothing is shown of it", person.scene.bda.scenario_path, "")
    person.take_reports()
    yield from person.picture("stopped")


def import_listed(person: Person) -> Steps:
    yield from person.click("bda.import_ifc_elements")
    settings = person.scene.bda
    yield from person.wait_for("the scenario is shown", lambda: bool(settings.scenario_path), 300.0)
    yield 0.5
    person.expect_reports("and it is said what became of the elements", "Imported ")
    wires = [shown for shown in person.scene.objects if shown.get("bda_role") == "IFC Left Out"]
    person.expect("what was left out is wire", {wire.display_type for wire in wires}, {"WIRE"})
    # Shapes of what the user left out are not worked out; approach slabs would hold the ends of the deck down.
    person.expect("they are the approach slabs", {wire.name[:14] for wire in wires}, {"OVERGANGSPLATE"})
    yield from person.picture("imported")


def import_at_once(person: Person, path) -> Steps:
    """Import the file again without looking into it, over the bridge that is built, and undo that."""
    settings, before = person.scene.bda, person.scene.bda.scenario_path
    yield from person.click("bda.import_ifc")
    yield from choose_file(person, path)
    yield from person.wait_for("another scenario is shown", lambda: settings.scenario_path != before, 300.0)
    yield 0.5
    person.expect("beside the first", settings.scenario_path.endswith(f"{path.stem}_scenario_2/scenario.toml"))
    person.take_reports()
    yield from undo(person)
    person.expect("Ctrl-Z shows the first again", person.scene.bda.scenario_path, before)
    yield from person.picture("undone")
