# SPDX-License-Identifier: GPL-3.0-or-later
"""The tutorials by file are done by their own words: files, commands, sums; with few shards and runs, to be quick."""

import re
import shlex
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

import pytest
from support.checkout import ROOT

from bridge_demolition_addon.cli.main import main

pytestmark = pytest.mark.long

PAGES = ("from_drawings", "first_charges", "exclusion_zone")
SMALLER = {
    "overpass.toml": (("duration_s = 5.0", "duration_s = 0.7"), ("shards = 120", "shards = 24")),
    "overpass_charges.toml": (),
    "overpass_study.toml": (("runs = 93", "runs = 1"), ("= 0.95\n", "= 0.5\n"), ("rank = 2", "rank = 1")),
}
"""Changes to the files of the pages before anything is run."""

GRAVITY_M_S2 = 9.81


def page(name):
    return (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")


def write_files(name, folder):
    """Write the files of a page, each from its blocks one after the other; a block may go on with a file of before."""
    path = None
    for block in re.findall(r"^```toml\n(.*?)^```", page(name), flags=re.S | re.M):
        if named := re.match(r"# (\w+\.toml)(, at its end)?\n", block):
            path = folder / named[1]
            before = path.read_text(encoding="utf-8") if named[2] else ""
            path.write_text(before + block, encoding="utf-8")
        else:
            path.write_text(path.read_text(encoding="utf-8") + "\n" + block, encoding="utf-8")


def make_smaller(folder):
    for name, changes in SMALLER.items():
        path = folder / name
        text = path.read_text(encoding="utf-8") if path.is_file() else None
        for old, new in changes if text else ():
            text = text.replace(old, new)
        if text:
            path.write_text(text, encoding="utf-8")


def commands(name):
    lines = [
        line for block in re.findall(r"^```sh\n(.*?)^```", page(name), flags=re.S | re.M) for line in block.splitlines()
    ]
    return [shlex.split(line) for line in lines]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Where the tutorials are done, one after the other."""
    return tmp_path_factory.mktemp("tutorials")


@pytest.fixture(scope="module")
def checked(folder):
    """What the pages have checked, with the bridge as they say it, by their names."""
    said = {}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        for name in PAGES[:2]:
            write_files(name, folder)
            (check,) = [words[1:] for words in commands(name) if words[1] == "check"]
            said[name] = output_of(check)
    return said


def output_of(words):
    with redirect_stdout(StringIO()) as out:
        assert main(words) == 0
    return out.getvalue()


def test_the_bridge_from_drawings_is_that_of_the_sums_by_hand(checked):
    said = checked["from_drawings"]
    deck_t = 24.8 * 5.5 * 0.65 * 2.5
    rest_t = 2.5 * (2 * 0.8 * 5.5 * 5.5 + 1.0 * 5.0 * 0.7 + 2 * 0.7 * 0.7 * 4.8)
    masses = {name: float(mass) for name, mass in re.findall(r"^  (deck|all) .* ([\d.]+) t$", said, flags=re.M)}
    assert masses == {"deck": pytest.approx(deck_t, abs=5e-4), "all": pytest.approx(deck_t + rest_t, abs=5e-4)}
    # A beam of two equal spans l with overhangs o, clamped in the middle by symmetry: 3/8 w l, w o, and what the moment
    # of the overhang adds, 3/2 of it over l.
    load_kn_m = deck_t * GRAVITY_M_S2 / 24.8
    outer_kn = 3 / 8 * load_kn_m * 12 + load_kn_m * 0.4 + 1.5 * load_kn_m * 0.4**2 / 2 / 12
    assert re.search(r"430 kN\. The program says 431 kN", page("from_drawings")) and round(outer_kn) == 430
    assert all(f"{load_kn_m:.1f} kN in each metre" in " ".join(page(name).split()) for name in PAGES[:2])
    reactions = [float(kn) for kn in re.findall(r"deck on abutment \d +([\d.]+) kN up", said)]
    assert [round(kn) for kn in reactions] == [431, 431]
    assert "The bridge stands under its own weight" in said


def test_its_bars_have_the_areas_of_the_drawing():
    along, across = 44 * 3.14159 * 25**2 / 4, 124 * 3.14159 * 16**2 / 4
    assert round(along, -2) == 21600 and round(across, -2) == 24900
    assert re.findall(r"area_mm2 = (\d+)", page("from_drawings")) == ["21600"] * 2 + ["24900"] * 2


def test_the_charges_are_those_of_the_sums_by_hand(checked):
    said = checked["first_charges"]
    mass_kg = 10 * 0.0735
    assert f"{mass_kg / (0.7 * 0.7 * 1.5):.2f} kg/m³ in 0.735 m³" in said and "1.00 kg/m³" in page("first_charges")
    assert re.search(r"all zones +1\.47 kg in 20 holes", said)
    assert f"{2 * mass_kg * 1000 / 363.16:.1f} g a tonne of the bridge" in said and "4.0 g" in page("first_charges")
    (resisted,) = re.findall(r"reinforcement +deck, along x: (\d+) kN·m with its top pressed", said)
    asked = 221.65 * GRAVITY_M_S2 / 24.8 * 24**2 / 8
    assert (f"{float(resisted) / 1000:.1f} MN·m", f"{asked / 1000:.1f} MN·m") == ("6.1 MN·m", "6.3 MN·m")
    assert "its bars resist 6.1 MN·m" in page("first_charges") and "6.3 MN·m" in page("first_charges")


@pytest.mark.parametrize("name", PAGES)
def test_its_commands_run_one_after_the_other(name, checked, folder, monkeypatch):
    monkeypatch.chdir(folder)
    for earlier in PAGES[: PAGES.index(name) + 1]:
        write_files(earlier, folder)
    make_smaller(folder)
    for program, *words in commands(name):
        assert program == "bda"
        if words[0] != "check":
            assert main(words) == 0, words
    for made in re.findall(r"`(overpass_\w+/[\w./]+)`", page(name)):
        assert Path(made).is_file(), made
