# SPDX-License-Identifier: GPL-3.0-or-later
"""Small studies in files, and the tables they leave."""

from dataclasses import replace

from support.scenarios import SHORT_RUN

from bridge_demolition_addon.model.scenario.file import scenario_text

TABLES = ("runs.csv", "runs.xlsx", "study.json")


def study_file(folder, runs=8, deeds=("nothing",), scenario=SHORT_RUN, **settings):
    """Write a study of a scenario whose title, and with it what a program of tests does, is drawn from deeds."""
    folder.mkdir(exist_ok=True)
    (folder / "scenario.toml").write_text(scenario_text(replace(scenario, title="Study")), encoding="utf-8")
    more = "".join(f"{name} = {value!r}\n" for name, value in settings.items())
    text = f"""
[study]
scenario = "scenario.toml"
runs = {runs}
quantile = 0.5
confidence = 0.5
rank = 1
{more}
[[vary]]
key = "scenario.title"
distribution = "choice"
values = {list(deeds)!r}

[[vary]]
key = "ball.mass_kg"
distribution = "uniform"
lowest = 8000.0
highest = 10000.0
"""
    path = folder / "study.toml"
    path.write_text(text, encoding="utf-8")
    return path


def tables_in(folder):
    """Bytes of the tables of a study."""
    return {name: (folder / name).read_bytes() for name in TABLES}
