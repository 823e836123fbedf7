# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the sections with bars by rule of docs/reinforcement.md: docs/pictures/reinforcement.png."""

from dataclasses import replace
from pathlib import Path

from bridge_demolition_addon.charts.reinforced_sections import draw_sections, sections_to_draw
from bridge_demolition_addon.charts.style import MM_PER_INCH, PAGE_WIDTH_MM, blank_figure
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.reinforcement.design import bar_schedule
from bridge_demolition_addon.model.scenario import BridgeReinforcement
from bridge_demolition_addon.model.scenario.file import read_scenario

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "examples" / "two_spans_13m_ball.toml"
PICTURE = ROOT / "docs" / "pictures" / "reinforcement.png"
HEIGHT_MM, DOTS_PER_INCH = 130.0, 130


def main() -> None:
    """Design the example's bars for load model 1, and draw its deck, a pier cap and a column."""
    scenario = read_scenario(EXAMPLE)
    bridge = replace(scenario.bridge, reinforcement=BridgeReinforcement(designed_for="LM1"))
    connections = replace(scenario.connections, ductile_elongation_m=0.05)
    scenario = replace(scenario, bridge=bridge, connections=connections)
    members = prepared_members(scenario).members
    schedule = bar_schedule(scenario, members)
    figure = blank_figure(PAGE_WIDTH_MM / MM_PER_INCH, HEIGHT_MM / MM_PER_INCH, layout="constrained")
    draw_sections(figure, sections_to_draw(members, schedule), schedule)
    figure.savefig(PICTURE, dpi=DOTS_PER_INCH, metadata={"Software": None})


if __name__ == "__main__":
    main()
