# SPDX-License-Identifier: GPL-3.0-or-later
"""The groups of the tab, each opened and looked at; and results come into view, open, when a run has ended."""

from habits import build
from panels import Panels, found_panels
from person import Person, Steps
from traces import recording_runs, something_goes_on

GROUPS = ("Bridge", "Demolition", "Run and Results", "Planning")
FRAMES = 12


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels, drawn = Panels(person), drawn_panels()
    yield from person.picture("first_look")
    labels = [panel.bl_label for _, panel in found_panels() if not getattr(panel, "bl_parent_id", "")]
    person.expect("a head and four groups are in the tab", labels, ["Scenario", *GROUPS])
    for group in GROUPS:
        yield from panels.show_only(group)
        yield from person.picture(group.replace(" ", "_"))
    drawn.clear()
    for panel in ("Contacts", "Weakenings", "Log Files", "Optimise"):  # at the ends of their groups
        yield from panels.show_only(panel)
        yield from person.picture(panel.replace(" ", "_"))
    person.expect("each opens", {"BDA_PT_contacts", "BDA_PT_weakenings"} <= drawn and "BDA_PT_optimise" in drawn)
    person.expect("what is in Advanced too", "BDA_PT_post_processing" in drawn)
    yield from results_come_into_view(person, panels, drawn)
    person.take_reports()


def results_come_into_view(person: Person, panels: Panels, drawn: set[str]) -> Steps:
    """Before a run there is no panel of results; after it there is one, and it is open."""
    yield from panels.show_only("Scenario")
    yield from build(person)
    yield from panels.show_only("Run")
    yield from person.picture("built")
    drawn.clear()
    person.sidebar.tag_redraw()
    yield 0.5
    person.expect("nothing is shown of results", drawn & {"BDA_PT_results", "BDA_PT_report"}, set())
    person.scene.bda.pictures_of_run = False
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 20.0)
    yield from person.wait_for("it plays", lambda: person.scene.frame_current >= FRAMES, 120.0)
    yield from person.move_to_view()
    yield from person.press("ESC")
    yield from person.wait_for("it stops", lambda: not something_goes_on(), 30.0)
    drawn.clear()
    yield 1.0
    person.expect("results and the report are open", {"BDA_PT_results", "BDA_PT_report"} <= drawn)
    yield from person.picture("results")
    for button in ("bda.look_at_bridge", "bda.make_report"):
        yield from person.hover(button)


def drawn_panels() -> set[str]:
    """Names of the panels that Blender draws from now on, into this set."""
    drawn: set[str] = set()

    def noting(name, draw):
        def noting_draw(self, context) -> None:
            drawn.add(name)
            draw(self, context)

        return noting_draw

    for name, panel in found_panels():
        panel.draw = noting(name, panel.draw)
    return drawn
