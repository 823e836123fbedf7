# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda optimise`` in Blender: a block that hangs, and the charge beside it that tears it off."""

import csv
import json
import sys

import pytest
from support.optimise_files import OPTIMISE, optimise_file

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.optimise.file import read_optimisation


def rows_of(path):
    return list(csv.DictReader(path.open(encoding="utf-8")))


@pytest.mark.long
def test_the_smallest_charge_is_found_and_confirmed_and_a_stopped_one_goes_on(tmp_path, capfd):
    path, output = optimise_file(tmp_path), tmp_path / "out"
    assert main(["optimise", str(path), "--output", str(output), "--jobs", "2"]) == 0
    said = capfd.readouterr().out
    found = json.loads((output / "optimise.json").read_text(encoding="utf-8"))
    trials, candidates = rows_of(output / "trials.csv"), rows_of(output / "candidates.csv")
    assert [sum(row["in.round"] == name for row in trials) for name in ("search", "final", "confirmation")] == [
        20,
        6,
        16,
    ]
    assert len(candidates) == 20
    # The one that is chosen is what the table has of it, with fewer kilograms than most that brought the block down.
    chosen = candidates[found["candidate"] - 1]
    assert found["values"]["charges.mass_kg"] == pytest.approx(float(chosen["charges.mass_kg"]))
    assert found["confirmed"]["value"] == pytest.approx(2.0 * found["values"]["charges.mass_kg"])
    held = sorted(float(row["charge_kg"]) for row in candidates if row["holds"] == "true")
    failed = [float(row["charge_kg"]) for row in candidates if row["holds"] == "false"]
    assert held and failed and found["confirmed"]["value"] <= held[1] < 50.0
    assert found["confirmed"]["runs"] == 16 and f"Candidate {found['candidate']} of 20 did best" in said
    assert ("not confirmed" in said) != found["confirmed"]["meets_the_probability"]
    # All candidates have the same runs.
    assert len({row["in.scenario.seed"] for row in trials if row["in.round"] == "search"}) == 1
    assert {row["in.charges.one.delay_ms"] for row in trials} == {"0.0", "20.0"}
    assert (output / "tradeoff.png").stat().st_size > 0
    before = {name: (output / name).read_bytes() for name in ("trials.csv", "candidates.csv", "optimise.json")}
    for draw in sorted((output / "draws").iterdir())[::8]:
        (draw / "outcome.json").unlink()
    assert main(["optimise", str(path), "--output", str(output), "--jobs", "1", "--quiet", "--report"]) == 0
    assert "Candidate" in (output / "report" / "report.html").read_text(encoding="utf-8")
    assert before == {name: (output / name).read_bytes() for name in before}


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("[[criteria]]", "[[neighbours]]"), "neighbours"),
        (
            (OPTIMISE[OPTIMISE.index("[[criteria]]") :], ""),
            "at least one table [[criteria]]: the smallest charge without",
        ),
        (
            ("confirmation_runs = 16", "confirmation_runs = 15"),
            "optimise.confirmation_runs is 15: expected at least 16",
        ),
        (("candidates = 20", "candidates = 9"), "optimise.candidates is 9"),
        (("candidates = 20", "candidates = 19"), "optimise.candidates is 19: expected at least 20, as 4 numbers"),
        (("finalists = 2", "finalists = 21"), "optimise.finalists is 21: expected at most optimise.candidates, 20"),
        (('"charges.mass_kg"', '"charges.mass"'), "[[quantities]] number 1: charges.mass is"),
        (('"charges.mass_kg"', '"ball.mass_kg"'), "[[quantities]] number 1: ball.mass_kg is not in the scenario"),
        (('"charges.mass_kg"', '"connections.strength_factor"'), "connections.strength_factor is chosen and sampled"),
        (("lowest = 0.001", "lowest = 200.0"), "quantities.highest is 100.0: expected more than"),
        (("highest = 100.0", "highest = 1e30"), "may come to 1e+30, which the scenario cannot have"),
        (("[1.0, 0.0, 9.5]", "[9.5, 0.0, 9.5]"), "expected no coordinate below that of places.lowest_corner_m"),
        (("[1.0, 0.0, 9.5]", "[9.0, 0.0, 9.5]"), "expected a coordinate above"),
        (("[9.0, 0.0, 9.5]", "[9.0, 0.0]"), "expected 3 numbers, as in lowest_corner_m"),
        (("charges.one.position_m", "charges.position_m"), "expected one of them, such as charges.one.position_m"),
        (('"charges.one.delay_ms", ', ""), "orders.keys is"),
        (("charges.one.delay_ms", "charges.one.mass_kg"), "charges.one.mass_kg is named more than once"),
        (('objective = "charge"', 'objective = "vibration"'), "optimise.neighbour is"),
        (('objective = "charge"', 'objective = "vibration"\nneighbour = "shed"'), 'optimise.neighbour is "shed"'),
        (('scenario = "scenario.toml"', 'scenario = "none.toml"'), "none.toml"),
    ],
)
def test_a_wrong_optimisation_is_refused_in_words(tmp_path, change, said, capfd):
    path = optimise_file(tmp_path, change)
    with pytest.raises(ScenarioError) as refused:
        read_optimisation(path)
    assert said in str(refused.value)
    assert main(["optimise", str(path), "--output", str(tmp_path / "out")]) == 2
    assert said in capfd.readouterr().err and not (tmp_path / "out").exists()


def test_what_is_needed_is_named_where_optuna_is_missing(tmp_path, monkeypatch, capfd):
    monkeypatch.setitem(sys.modules, "optuna", None)
    path = optimise_file(tmp_path)
    assert main(["optimise", str(path), "--output", str(tmp_path / "out")]) == 2
    assert "pip install 'bridge-demolition-addon[optimise]'" in capfd.readouterr().err
    assert not (tmp_path / "out").exists()


def test_places_and_orders_become_values_of_the_scenario(tmp_path):
    found = read_optimisation(optimise_file(tmp_path))
    assert found.space.size == 4
    run = found.run_of(3, [0.5, 0.25, 0.9, 0.1])
    one, other = run.scenario.charges
    assert one.position_m == (3.0, 0.0, 9.5) and (one.delay_ms, other.delay_ms) == (20.0, 0.0)
    assert one.mass_kg == other.mass_kg == pytest.approx(0.316228, rel=1e-5)
    same_number = found.run_of(3, [0.1, 0.1, 0.1, 0.9])
    assert same_number.scenario.seed == run.scenario.seed != found.run_of(4, [0.5, 0.25, 0.9, 0.1]).scenario.seed
    assert same_number.inputs["connections.strength_factor"] == run.inputs["connections.strength_factor"]
