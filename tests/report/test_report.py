# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports from the folders of runs: complete in themselves, whole or cut short, one or several."""

import csv
import re
import shutil
import subprocess
from base64 import b64decode
from dataclasses import replace
from html.parser import HTMLParser
from xml.etree import ElementTree

import numpy as np
import pytest
from manifold3d import CrossSection
from matplotlib.figure import Figure
from matplotlib.image import imsave
from support.long_cases import long_but
from support.moving_boxes import moving_boxes
from support.report_texts import compared, told
from support.run_folders import TOLD, flying_shards, keep_run, killed_run, stream_run
from support.sample_results import changed
from support.scenarios import I235

from bridge_demolition_addon.charts.blast_maps import overpressure_map
from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.blast.pulses import BlastModel
from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.model.debris.throws import debris_of
from bridge_demolition_addon.model.debris.touchdown import landings, shaking_at
from bridge_demolition_addon.model.results.arrays import RESULTS_FILE
from bridge_demolition_addon.model.run_folder.files import SUMMARY_FILE
from bridge_demolition_addon.model.scenario import BallCable, BallHit, Load
from bridge_demolition_addon.report.document.blocks import Paragraph
from bridge_demolition_addon.report.findings import findings
from bridge_demolition_addon.report.run_folder import read_run
from bridge_demolition_addon.report.sections.collapse import collapse_section
from bridge_demolition_addon.report.sections.summary import run_summary
from bridge_demolition_addon.report.write import write_report
from bridge_demolition_addon.system.folder_lock import FolderLock

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
PNG = b"\x89PNG\r\n\x1a\n"
TORN_LINES = ["5,1.5,Ground,1,2,3", "5,1.5,Sh"]


class Page(HTMLParser):
    """What is on a page: its texts, pictures and headings, and all that would be fetched from elsewhere."""

    def __init__(self, html):
        super().__init__()
        self.tags, self.texts, self.pictures, self.fetched, self.notices = [], [], [], [], []
        self._in_notice = False
        self.feed(html)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags.append(tag)
        self._in_notice = "notice" in attributes.get("class", "")
        for name in ("src", "href"):
            if attributes.get(name, "#").startswith("data:image"):
                self.pictures.append(attributes[name])
            elif name in attributes and not attributes[name].startswith(("#", "data:,")):
                self.fetched.append(attributes[name])

    def handle_data(self, data):
        self.texts.append(data)
        if self._in_notice:
            self.notices.append(data)

    def handle_endtag(self, tag):
        self._in_notice = False

    @property
    def text(self):
        return " ".join(self.texts)


def made(folder, *more, **options):
    """The page of a report, and all files written."""
    written = write_report([folder, *more], options.pop("output", None), progress=Silence(), **options)
    return Page(written[0].read_text(encoding="utf-8")), written


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A run with everything that a report can show, and its report."""
    folder = keep_run(tmp_path_factory.mktemp("runs") / "whole", flying_shards())
    return folder, *made(folder, trajectories=True)


def notices_on_the_first_page(run):
    summary = run_summary(run, debris_of(run.results))
    return {block.text for block in summary if isinstance(block, Paragraph) and block.is_notice}


def table(folder, name):
    with (folder / "tables" / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_everything_is_in_the_page(whole):
    _, page, _ = whole
    assert page.fetched == [] and page.tags.count("script") == 1
    assert len(page.pictures) == page.tags.count("img") >= 12
    for picture in page.pictures:
        kind, content = picture.split(";base64,")
        decoded = b64decode(content, validate=True)
        if kind == "data:image/svg+xml":
            assert ElementTree.fromstring(decoded).tag.endswith("svg")
        else:
            assert decoded.startswith(PNG)


def test_names_of_the_user_are_text_and_nothing_else(whole):
    _, page, _ = whole
    assert TOLD.title in page.texts
    assert "b" not in page.tags
    assert "Road <1> $2$" in page.texts


def test_all_sections_are_there(whole):
    _, page, _ = whole
    numbered = re.findall(
        r"\d (The run|What is modelled[^1]*?|Debris|Exclusion zone|Forces|Collapse|Blast|Shaking of the ground[a-z ]*"
        r"|The scenario)",
        page.text,
    )
    assert len(set(map(str.strip, numbered))) == 9


def test_the_pdf_is_one(whole):
    _, _, written = whole
    content = written[1].read_bytes()
    assert content.startswith(b"%PDF-") and content.rstrip().endswith(b"%%EOF")
    assert len(re.findall(rb"/Type /Page\b", content)) >= 8


@pytest.mark.long
def test_the_same_run_gives_the_same_report(whole, tmp_path):
    folder, _, written = whole
    made(folder, output=tmp_path, trajectories=True)
    for path in written:
        again = tmp_path / path.relative_to(folder)
        assert again.read_bytes() == path.read_bytes(), path.name


def test_tables_hold_what_the_results_say(whole):
    folder, _, _ = whole
    results = flying_shards()
    first, last = results.frames.positions_m[0, :-1], results.frames.positions_m[-1, :-1]
    throws = np.hypot(*(last - first)[:, :2].T)
    rows = table(folder, "largest_throws")
    assert [row["shard"] for row in rows] == [f"Shard {row:05d}" for row in np.argsort(-throws)[:10]]
    assert [float(row["throw_m"]) for row in rows] == pytest.approx(sorted(throws, reverse=True)[:10])
    road, far = table(folder, "zones")
    assert int(road["bodies_entered"]) > 0 and float(road["first_entry_s"]) > 0.0
    assert (far["bodies_entered"], far["first_entry_s"]) == ("0", "")
    assert {row["charge"]: float(row["mass_kg"]) for row in table(folder, "charges")} == {"Charge 1": 5, "Charge 2": 2}
    assert [row["neighbour"] for row in table(folder, "neighbours")] == ["House", "School & yard"]
    landed = landings(results)
    shaken = {row["neighbour"]: float(row["peak_particle_velocity_mm_s"]) for row in table(folder, "touchdown")}
    expected = {
        neighbour.name: 1e3 * shaking_at(neighbour.position_m, landed).velocity_m_s for neighbour in TOLD.neighbours
    }
    assert shaken == pytest.approx(expected)
    assert max(shaken.values()) > 0.1
    broken = sum(int(row["broken"]) for row in table(folder, "breaking"))
    assert broken == (~results.frames.intact[-1]).sum()
    (hit,) = table(folder, "hits_of_the_ball")
    assert float(hit["impulse_kNs"]) == pytest.approx(50.0)


def test_loads_beyond_the_one_breaking_force_are_explained(whole):
    _, page, _ = whole
    assert any("√3 times as large" in text for text in page.texts)


def test_a_load_is_told_as_large_as_it_was_when_the_bridge_gave_way(tmp_path):
    """All move from the beginning, and the first connections break after ten frames of 1 / 24 s."""
    load = Load(members=("deck",), times_s=(0, 1), forces_n=(0, 24e3))
    section = collapse_section(read_run(keep_run(tmp_path / "run", flying_shards(6), replace(I235, loads=(load,)))))
    (rows,) = (block.rows for block in section.blocks if getattr(block, "name", "") == "collapse")
    assert rows[-1] == ("Load 1 on deck", "10 kN at the first break; 0 kN as the first shard moved; 24 kN at the end")


def test_site_plans_lie_beside_it(whole):
    _, _, written = whole
    assert {path.name for path in written} >= {
        "exclusion_zone_of_one_run.dxf",
        "exclusion_zone_of_one_run.geojson",
        "exclusion_corners_of_one_run.csv",
    }
    assert all(path.is_file() for path in written)


def test_without_charges_and_ball_there_is_no_word_of_them(tmp_path):
    results = moving_boxes([0, 1], [(1, 1, 1)] * 2, [[(0, 0, 5), (3, 0, 5)], [(1, 1, 0.5), (3, 2, 0.5)]])
    report = told(keep_run(tmp_path / "run", results, replace(I235, ball=None, exclusion=None)))
    assert "Blast" not in report.titles and "There is no ball in this run." in report.paragraphs
    assert "charges" not in report.tables
    assert any("gives no exclusion zone. Add the table [exclusion]" in text for text in report.notices)


@pytest.mark.parametrize("place", [(4.0, 2.0, 30.0), (900.0, 0.0, 30.0)])
def test_the_map_of_a_charge_whose_rings_do_not_reach_the_ground_shows_the_bridge(place):
    figure = Figure()
    bridge = CrossSection.square((9.0, 4.0))
    overpressure_map(
        figure, [Charge(name="high", position_m=place, mass_kg=0.001)], bridge, (), BlastModel.KINGERY_BULMASH
    )
    figure.canvas.draw()
    left, right = figure.axes[0].get_xlim()
    assert left <= 0.0 and right >= max(9.0, place[0])


@pytest.mark.long
def test_a_run_of_one_frame_says_so(tmp_path):
    results = flying_shards(6)
    series = {name: array[:1] for name, array in results.arrays().items() if np.shape(array)[:1] == (25,)}
    no_ball = {name: results.arrays()[name][:0] for name in ("ball_times_s", "ball_impulses_ns", "ball_velocities_m_s")}
    page, written = made(keep_run(tmp_path / "run", changed(results, **series | no_ball)))
    assert any("Only one frame" in text for text in page.notices)
    assert any("there is no debris" in text for text in page.notices)
    assert written[1].stat().st_size > 0


def test_a_run_that_was_stopped_says_so(tmp_path):
    run = read_run(keep_run(tmp_path / "run", flying_shards(), completed=False))
    assert run.first_doubts[0] == "Stopped at 1.00 s, before its end: what follows is no outcome"
    assert " ".join(f"{doubt}." for doubt in run.first_doubts) in notices_on_the_first_page(run)


@pytest.mark.parametrize("last_lines", long_but([[]], [[], TORN_LINES]), ids=["whole", "in mid-line"])
def test_a_run_that_was_killed_tells_what_its_logs_hold(tmp_path, last_lines):
    page, _ = made(killed_run(tmp_path / "run", last_lines))
    assert any("was killed before it could write results.npz" in text for text in page.notices)
    assert any("not whole" in text for text in page.notices) is bool(last_lines)
    assert "1.000 s as far as logged" in page.texts
    assert "Connections cracked or torn as far as logged: 2." in page.texts
    assert len(page.pictures) == 1


@pytest.mark.long
def test_frames_of_a_killed_run_give_the_hits_that_its_summary_would_give(tmp_path):
    results = flying_shards()
    whole = keep_run(tmp_path / "whole", results)
    killed = keep_run(tmp_path / "killed", results)
    for name in (RESULTS_FILE, SUMMARY_FILE):
        (killed / name).unlink()
    stream_run(killed, results)
    hits, left = (told(folder).tables["hits_of_the_ball"] for folder in (whole, killed))
    assert len(hits.rows) == 1
    np.testing.assert_allclose(left.rows[0][1:], hits.rows[0][1:], rtol=1e-6)  # frames are kept with seven digits
    assert read_run(killed).ball.first_hit_s == pytest.approx(read_run(whole).ball.first_hit_s)
    assert any("The run ended before its end" in text for text in read_run(killed).shortcomings)


def test_a_folder_that_is_locked_by_the_report_of_a_killed_run_is_of_no_run_at_work(tmp_path):
    killed = keep_run(tmp_path / "killed", flying_shards())
    (killed / RESULTS_FILE).unlink()
    stream_run(killed, flying_shards())
    with FolderLock(killed):
        assert any("The run ended before its end" in text for text in read_run(killed).shortcomings)
    with FolderLock(killed, work="a run"):
        assert any("The run is still at work (process " in text for text in read_run(killed).shortcomings)


class ClearedMeanwhile(Silence):
    """A run that begins in the folder once all of it is read."""

    def __init__(self, folder):
        self._folder = folder

    def stage(self, text):
        if text.startswith("drawing"):
            for name in ("after.png", "before.png"):
                (self._folder / "frames" / name).unlink(missing_ok=True)


def test_a_folder_that_is_cleared_meanwhile_ends_the_report_with_a_message(tmp_path):
    folder = keep_run(tmp_path / "run", flying_shards(6, 13), I235)
    (folder / "frames").mkdir()
    imsave(folder / "frames" / "before.png", np.zeros((4, 4)))
    with pytest.raises(OutputError, match=r"before\.png: No such file or directory\): a folder was cleared meanwhile"):
        write_report([folder], tmp_path / "report", progress=ClearedMeanwhile(folder))


def test_a_scene_that_was_built_by_hand_has_no_scenario(tmp_path):
    folder = keep_run(tmp_path / "run", flying_shards(6, 13), None)
    assert any("There is no scenario_as_run.toml" in text for text in told(folder).notices)
    assert read_run(folder).title == "By hand"


@pytest.mark.parametrize(
    "name, content, said",
    [
        ("summary.json", "{", "summary.json cannot be read"),
        ("summary.json", "[]", "summary.json is not what a run writes"),
        ("summary.json", None, "There is no summary.json"),
        ("scenario_as_run.toml", "x = ", "The scenario of the run cannot be read: "),
        ("scenario_as_run.toml", None, "There is no scenario_as_run.toml"),
    ],
)
def test_what_cannot_be_read_is_said(tmp_path, name, content, said):
    folder = keep_run(tmp_path / "run", flying_shards())
    (folder / name).unlink()
    if content is not None:
        (folder / name).write_text(content, encoding="utf-8")
    run = read_run(folder)
    (shortcoming,) = run.shortcomings
    assert shortcoming.startswith(said)
    assert shortcoming in notices_on_the_first_page(run)
    assert (run.summary is None) is (name == "summary.json")
    assert (run.scenario is None) is (name != "summary.json")


def run_with_damaged_picture(folder, damage):
    """A run's folder with a picture of its end, and one of its start that is damaged."""
    keep_run(folder, flying_shards(6, 13), I235)
    before, after = (folder / "frames" / f"{name}.png" for name in ("before", "after"))
    before.parent.mkdir(exist_ok=True)
    for path in (before, after):
        imsave(path, np.zeros((90, 160, 3)))
    whole = before.read_bytes()
    before.unlink()
    if damage == "a folder":
        before.mkdir()
    else:
        before.write_bytes({"emptied": b"", "cut short": whole[:-30], "no picture": b"GIF"}[damage])
    return folder


@pytest.mark.parametrize("damage", ["emptied", "cut short", "no picture", "a folder"])
def test_a_damaged_picture_is_said_and_left_out(tmp_path, damage):
    run = read_run(run_with_damaged_picture(tmp_path / "run", damage))
    assert list(run.pictures) == ["after"]
    assert run.shortcomings == ("frames/before.png is no whole picture, and is left out.",)


@pytest.mark.long
def test_a_report_is_written_without_a_damaged_picture(tmp_path):
    # What was read is the same for every damage, and the report is of what was read.
    folder = run_with_damaged_picture(tmp_path / "run", "cut short")
    write_report([folder], None, progress=Silence())
    assert (folder / "report.pdf").stat().st_size > 0


def test_damaged_results_are_said_and_left_out(tmp_path):
    folder = killed_run(tmp_path / "run")
    (folder / "results.npz").write_bytes(b"PK")
    page, _ = made(folder)
    assert any("results.npz cannot be read" in text for text in page.notices)


def test_a_recording_without_forces_is_reported_without_them(tmp_path):
    results = flying_shards(6, 13)
    unknown = {
        name: np.full_like(results.arrays()[name], np.nan)
        for name in ("body_sums_n", "body_peak_sums_n", "body_contact_impulses_ns", "von_mises_pa", "stresses_pa")
    }
    report = told(keep_run(tmp_path / "run", changed(results, **unknown), I235))
    assert any("Forces were not recorded" in text for text in report.notices)
    assert "Collapse" in report.titles


@pytest.mark.parametrize("what", ["nothing", "a file", "an empty folder", "another folder"])
def test_what_is_no_run_is_refused(tmp_path, what):
    folder = tmp_path / "run"
    if what == "a file":
        folder.write_text("")
    elif what != "nothing":
        folder.mkdir()
    if what == "another folder":
        (folder / "summary.json").write_text("{}")
    message = {"nothing": "found nothing", "a file": "found a file"}.get(what, "holds no run: expected results.npz")
    with pytest.raises(OutputError, match=message):
        made(folder)
    assert not (folder / "report.html").exists()


@pytest.mark.parametrize("share, words", [(0.0, "nothing moved"), (1.0, "not at rest at the end")])
def test_a_bridge_that_stands_is_not_told_of_as_one_that_still_falls(tmp_path, share, words):
    flying = flying_shards(6, 14)
    positions, speeds = flying.frames.positions_m, flying.frames.velocities_m_s
    run = keep_run(
        tmp_path / "run",
        changed(flying, places_m=positions[:1] + share * (positions - positions[:1]), velocities_m_s=share * speeds),
        replace(TOLD, ball=None),
    )
    read = read_run(run)
    (rest,) = (
        finding for finding in findings(read, debris_of(read.results)) if finding.label == "All shards at rest from"
    )
    assert (rest.value, rest.text) == (None, words)


def test_runs_are_set_side_by_side(tmp_path):
    results = flying_shards()
    halved = changed(
        results,
        places_m=results.frames.positions_m[:1] + (results.frames.positions_m - results.frames.positions_m[:1]) / 2,
    )
    folders = [keep_run(tmp_path / name / "run", recorded) for name, recorded in (("a", results), ("b", halved))]
    page, _ = made(*folders, output=tmp_path / "both")
    rows = {row["finding"]: row for row in table(tmp_path / "both", "comparison")}
    throw = rows["Largest throw"]
    assert float(throw["run (1)"]) == pytest.approx(2.0 * float(throw["run (2)"]))
    assert len(page.pictures) == 4
    for name in ("run (1)", "run (2)"):
        assert any(re.match(rf"{re.escape(name)}: \d+ of 30 shards still move", text) for text in page.notices)
    assert not (folders[0] / "report.html").exists()


@pytest.mark.parametrize(
    "names, shown",
    [
        (("bridge_mid_span", "bridge_near_end"), ("mid_span", "near_end")),
        (("bridge_1", "bridge_12"), ("1", "12")),
        (("bridge", "bridges"), ("bridge", "bridges")),
        (("bridge_", "bridge_a"), ("bridge_", "bridge_a")),
    ],
)
def test_words_that_all_names_begin_with_are_left_out(tmp_path, names, shown):
    folders = [keep_run(tmp_path / name, flying_shards(6, 13)) for name in names]
    report = compared(*folders)
    assert report.column("runs", "run") == list(shown)
    assert any("begin with bridge_, which is left out here" in text for text in report.paragraphs) == (names != shown)


def test_what_sets_runs_apart_is_told_of_each(tmp_path):
    hit = BallHit(target_m=(3.0, 1.5), drop_height_m=6.0, lift_time_s=2.0, release_time_s=4.5, lift_duration_s=2.0)
    cable = BallCable(crane_point_m=(6.5, -6.0, 20.0), length_m=12.0, angle_degrees=30.0)
    balls = {
        "once": I235.ball,
        "twice": replace(I235.ball, hits=(hit,)),
        "swing": replace(I235.ball, target_m=None, drop_height_m=None, cable=cable),
    }
    folders = [
        keep_run(tmp_path / name, flying_shards(6, 13), replace(I235, ball=ball)) for name, ball in balls.items()
    ]
    assert compared(*folders).column("runs", "means") == [
        "ball of 10 t from 5 m on (6.5, 0) m",
        "ball of 10 t from 5 m on (6.5, 0) m, then from 6 m on (3, 1.5) m",
        "ball of 10 t on a cable of 12 m, drawn aside by 30°",
    ]


def test_a_killed_run_beside_a_whole_one_is_named(tmp_path):
    report = compared(keep_run(tmp_path / "whole", flying_shards(6, 13)), killed_run(tmp_path / "killed"))
    assert any(text.startswith("killed: The run was killed") for text in report.notices)
    assert [column.key for column in report.tables["comparison"].columns] == ["finding", "unit", "whole"]


def test_several_runs_need_a_folder_of_their_own(tmp_path):
    folder = killed_run(tmp_path / "run")
    with pytest.raises(OutputError, match="give one with --output"):
        made(folder, folder)


needs_chromium = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium on the path to open the page in")

COUNT_PICTURES = """<script>addEventListener("load", () => {
  const broken = [...document.images].filter(image => !image.complete || !image.naturalWidth);
  document.body.dataset.broken = broken.length;
});</script></body>"""


def opened(tmp_path, *arguments):
    options = ("--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--no-first-run")
    command = [CHROMIUM, *options, f"--user-data-dir={tmp_path / 'profile'}", "--enable-logging=stderr", *arguments]
    return subprocess.run(command, capture_output=True, text=True, encoding="utf-8", timeout=120, check=True)


def broken_pictures(tmp_path, html):
    path = tmp_path / "counted.html"
    path.write_text(html.replace("</body>", COUNT_PICTURES), encoding="utf-8")
    shown = opened(tmp_path, "--dump-dom", path.as_uri())
    said = [line for line in shown.stderr.splitlines() if "CONSOLE" in line and "WebGL" not in line]
    return int(re.search(r'data-broken="(\d+)"', shown.stdout)[1]), said


@needs_chromium
def test_a_browser_shows_it_without_a_complaint(whole, tmp_path):
    _, _, written = whole
    broken, complaints = broken_pictures(tmp_path, written[0].read_text(encoding="utf-8"))
    assert broken == 0
    assert complaints == []  # but that WebGL has no graphics card here
    spoilt = written[0].read_text(encoding="utf-8").replace("base64,PD94", "base64,AAAA", 1)
    assert broken_pictures(tmp_path, spoilt)[0] == 1  # the count can tell


@needs_chromium
def test_a_browser_prints_it(whole, tmp_path):
    _, _, written = whole
    printed = tmp_path / "printed.pdf"
    opened(tmp_path, f"--print-to-pdf={printed}", "--no-pdf-header-footer", written[0].as_uri())
    assert printed.read_bytes().startswith(b"%PDF-")
    assert len(re.findall(rb"/Type ?/Page\b", printed.read_bytes())) >= 5
