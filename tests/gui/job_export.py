# SPDX-License-Identifier: GPL-3.0-or-later
"""A run is exported from the menu of the panel Results, and reported with a Word file."""

import re
from pathlib import Path
from zipfile import ZipFile

from habits import build
from panels import Panels
from person import Person, Steps
from traces import recording_runs, something_goes_on

BELOW_PX = 52
"""From the button *Draw Charts* to the menu, with a row between."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from build(person)
    results = person.folder / "results"
    person.scene.bda.output_directory = str(results)
    person.scene.bda.pictures_of_run = False
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 20.0)
    yield from person.wait_for("it is over", lambda: not something_goes_on(), 120.0)
    person.take_reports()
    yield from panels.show_only("Results")
    yield from choose(person, "glTF", 2)
    yield from person.wait_for("the model is there", (results / "export.glb").is_file, 60.0)
    yield from person.wait_for("and it is over", lambda: not something_goes_on(), 20.0)
    person.expect_reports("the file is named", f"Animated Model (glTF): {results / 'export.glb'}")
    yield from choose(person, "XLSX", 1)
    yield from person.wait_for("the workbook is there", (results / "export.xlsx").is_file, 60.0)
    yield from person.wait_for("and it is over", lambda: not something_goes_on(), 20.0)
    person.expect_reports("the workbook is named", f"Spreadsheet (XLSX): {results / 'export.xlsx'}")
    person.expect(
        "it has the tables of the run", {"units", "debris_log", "breaking_log"} <= sheets(results / "export.xlsx")
    )
    yield from choose(person, "ParaView", 0)
    yield from person.wait_for("the series is there", (results / "export" / "bodies.pvd").is_file, 60.0)
    yield from person.wait_for("and it is over", lambda: not something_goes_on(), 20.0)
    person.take_reports()
    yield from report_in_word(person, panels, results)


def report_in_word(person: Person, panels: Panels, results: Path) -> Steps:
    yield from panels.show_only("Report")
    yield from person.click("bda.make_word_report")
    yield from person.wait_for("the Word file is there", (results / "report.docx").is_file, 600.0)
    yield from person.wait_for("and it is over", lambda: not something_goes_on(), 60.0)
    with ZipFile(results / "report.docx") as parts:
        person.expect("it is a document of Word", "word/document.xml" in parts.namelist())
    person.expect_reports("page and Word file are named", "report.docx")


def sheets(workbook: Path) -> set[str]:
    """Names of the sheets of a workbook, which is a zip."""
    with ZipFile(workbook) as parts:
        return set(re.findall(r'<sheet name="([^"]+)"', parts.read("xl/workbook.xml").decode("utf-8")))


def choose(person: Person, name: str, number: int) -> Steps:
    """Open the menu below *Draw Charts*, and take a format of it by the keyboard."""
    yield from person.hover("bda.draw_charts")
    x, y = person.mouse
    yield from person.move(x, y - BELOW_PX)
    yield 0.3
    yield from person.press("LEFTMOUSE")
    yield 1.0
    yield from person.picture(f"menu_{name}")
    yield from person.press("HOME")
    for _ in range(number):
        yield from person.press("DOWN_ARROW")
    yield from person.press("RET")
    yield 0.5
