# SPDX-License-Identifier: GPL-3.0-or-later
"""Study files: read strictly, and refused with what to do."""

import pytest
from support.checkout import I235_FILE

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.study.file import read_study
from bridge_demolition_addon.model.study.sampled_runs import sampled_run

HEADING = f'[study]\nscenario = "{I235_FILE.as_posix()}"\n'


def study_file(folder, text, heading=HEADING):
    path = folder / "study.toml"
    path.write_text(heading + text, encoding="utf-8")
    return path


def vary(key="ball.drop_height_m", **keys):
    lines = [f"{name} = {value}" for name, value in keys.items()]
    return "\n".join(["[[vary]]", f"key = '{key}'", *lines, ""])


NORMAL = {"distribution": '"normal"', "mean": 5.0, "deviation": 0.3}


@pytest.mark.parametrize("runs", [1, 4, 59, 93])
def test_any_number_of_runs_may_begin_and_a_run_does_not_depend_on_it(tmp_path, runs):
    study = read_study(study_file(tmp_path, f"runs = {runs}\n" + vary(**NORMAL)))
    more = read_study(study_file(tmp_path, f"runs = {runs + 8}\n" + vary(**NORMAL)))
    assert study.settings.runs == runs
    assert sampled_run(study, 1).cache_key({}) == sampled_run(more, 1).cache_key({})


def test_a_study_without_anything_else_has_93_runs_and_takes_the_second_largest(tmp_path):
    study = read_study(study_file(tmp_path, ""))
    settings = study.settings
    assert (settings.runs, settings.quantile, settings.confidence, settings.rank) == (93, 0.95, 0.95, 2)
    assert study.scenario == read_scenario(I235_FILE)
    assert study.variations == study.criteria == ()


def test_the_scenario_is_looked_for_from_the_folder_of_the_study(tmp_path, monkeypatch):
    (tmp_path / "inner").mkdir()
    (tmp_path / "bridge.toml").write_bytes(I235_FILE.read_bytes())
    path = study_file(tmp_path / "inner", "", '[study]\nscenario = "../bridge.toml"\n')
    monkeypatch.chdir("/")
    assert read_study(path).scenario == read_scenario(I235_FILE)


def test_a_study_is_written_and_read_back_with_the_same_draws(tmp_path):
    text = vary(**NORMAL) + vary("connections.type", distribution='"choice"', values='["FIXED", "HINGE"]')
    study = read_study(study_file(tmp_path, text + '[[criteria]]\nname = "down"\nkind = "span down"\nspan = 1\n'))
    (tmp_path / "study.toml").write_text(study.text, encoding="utf-8")
    (tmp_path / "scenario_as_run.toml").write_text(study.scenario_text, encoding="utf-8")
    again = read_study(tmp_path / "study.toml")
    assert (again.text, again.scenario, again.criteria) == (study.text, study.scenario, study.criteria)
    assert [sampled_run(again, number).inputs for number in (1, 93)] == [
        sampled_run(study, number).inputs for number in (1, 93)
    ]


@pytest.mark.parametrize(
    "text, message",
    [
        ("run = 5", "study.run is unknown: did you mean study.runs?"),
        ("[vari]", "vari is unknown: did you mean vary?"),
        ('runs = "many"', 'study.runs is "many": expected a whole number from 1 to'),
        ("runs = 0", "study.runs is 0: expected a whole number from 1 to"),
        ("quantile = 1.0", "study.quantile is 1.0: expected a number from 0.5 to 0.9999"),
        (vary(distribution='"gauss"'), 'number 1: vary.distribution is "gauss": expected one of "normal", "lognormal"'),
        (vary(distribution='"normal"', mean=5.0), 'vary.deviation is missing: expected it with distribution "normal"'),
        (vary(**NORMAL, median=3.0), 'vary.median is 3.0: expected none with distribution "normal"'),
        (vary(**NORMAL | {"mean": '"high"'}), 'vary.mean is "high": expected a number'),
        (vary(**NORMAL | {"deviation": 0}), "vary.deviation is 0: expected a number above 0"),
        (vary(distribution='"uniform"', lowest=2, highest=2), "vary.highest is 2.0: expected more than vary.lowest, 2"),
        (
            vary(distribution='"triangular"', lowest=1, most_likely=4, highest=3),
            "vary.most_likely is 4.0: expected a number from vary.lowest to vary.highest, 3",
        ),
        (
            vary(distribution='"lognormal"', median=1, variation=0.1, lowest=-1),
            "vary.lowest is -1.0: expected at least 0 with a lognormal distribution",
        ),
        (vary(**NORMAL, lowest=8, highest=9), "less than 1e-06 of this distribution lies from lowest to highest"),
        (vary(**NORMAL) + vary(**NORMAL), "number 2: ball.drop_height_m is sampled more than once"),
        (vary("scenario.seed", **NORMAL), "vary.key is scenario.seed, which is always sampled: leave it out"),
        (vary("ball.height_m", **NORMAL), "number 1: ball.height_m is unknown: did you mean ball.drop_height_m?"),
        (
            vary(**NORMAL | {"deviation": 1.0}),
            "number 1: a run may sample ball.drop_height_m = -3.20954: expected a number above 0 and up to 10000.0 "
            "(m); set lowest and highest, or take another distribution",
        ),
        (
            vary("ball.mass_kg", distribution='"uniform"', lowest=-0.1, highest=1.0, factor="true"),
            "a run may sample ball.mass_kg = -1000: expected a number above 0",
        ),
        (
            vary("ball.target_m.1", distribution='"uniform"', lowest=5, highest=50),
            "a run may sample ball.target_m.1 = 50: expected a position on the deck",
        ),
        (vary("connections.type", **NORMAL), "a run may sample connections.type = 2.537"),
        (
            vary("fracture.shards", distribution='"uniform"', lowest=100, highest=200),
            "a run may sample fracture.shards = 100: expected a whole number from 1 to 1000000",
        ),
        (
            vary("connections.type", distribution='"choice"', values='["HINGE", "GLUE"]'),
            'a run may sample connections.type = "GLUE": expected one of "FIXED"',
        ),
        (vary("fracture.shards", distribution='"choice"', values="[]"), "vary.values is a list of length 0: expected"),
        (
            vary(distribution='"choice"', values="[[1.0]]"),
            "vary.values.1 is a list of length 1: expected a list of one or more numbers, texts, true or false",
        ),
        (
            vary("connections.type", distribution='"choice"', values='["FIXED"]', factor="true"),
            "vary.factor is true: expected false where values are not numbers",
        ),
        (
            vary("bridge.density_kg_m3", **NORMAL, factor="true"),
            "vary.factor is true: bridge.density_kg_m3 has no number in the scenario to multiply",
        ),
        (
            vary("bridge.density_kg_m3", **NORMAL | {"mean": 2400.0}),
            "bridge.density_kg_m3 and bridge.mass_kg are given together",
        ),
        ('[[criteria]]\nname = "it"\nkind = "span down"\nspan = 2', "[[criteria]] number 1: criteria.span is 2"),
        ("runs = 1e", "not a TOML file"),
    ],
)
def test_what_cannot_be_studied_is_refused_on_one_line(tmp_path, text, message):
    path = study_file(tmp_path, text)
    with pytest.raises(ScenarioError) as refused:
        read_study(path)
    assert str(refused.value).startswith(f"{path}: ")
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    "heading, message",
    [
        ("", "is empty: expected a study in TOML"),
        ("[study]\nseed = 1\n", "study.scenario is missing: expected a text"),
        ('[study]\nscenario = "missing.toml"\n', "missing.toml: no such file"),
        ('[study]\nscenario = "study.toml"\n', "this is a study: use bda study"),
        ('[study]\nscenario = "a\\u0000b"\n', "expected a text on one line"),
        ("study = 3\n", "study is 3: expected a table"),
    ],
)
def test_a_study_without_a_scenario_is_refused(tmp_path, heading, message):
    with pytest.raises(ScenarioError) as refused:
        read_study(study_file(tmp_path, "", heading))
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_file_that_is_none_is_refused(tmp_path):
    with pytest.raises(ScenarioError, match="is a directory: expected a study in TOML"):
        read_study(tmp_path)


def test_a_narrow_normal_distribution_needs_no_ends(tmp_path):
    # 8.2 deviations below 5 m are still 2.5 m.
    study = read_study(study_file(tmp_path, vary(**NORMAL)))
    heights = [sampled_run(study, number).inputs["ball.drop_height_m"] for number in range(1, 94)]
    assert 4.0 < min(heights) < max(heights) < 6.0


def test_factors_multiply_what_the_scenario_has(tmp_path):
    text = vary("ball.mass_kg", distribution='"uniform"', lowest=0.9, highest=1.1, factor="true")
    study = read_study(study_file(tmp_path, text))
    masses = [sampled_run(study, number).inputs["ball.mass_kg"] for number in range(1, 94)]
    assert 9_000.0 <= min(masses) < 9_500.0 < 10_500.0 < max(masses) <= 11_000.0
