# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever ends a study, the same command goes on, reruns nothing that is done, and comes to the same tables."""

import io
import json
import os
import shutil
import signal
import sys
import time
from collections import Counter
from contextlib import redirect_stderr, redirect_stdout
from functools import partial

import pytest
from support.long_cases import long_but
from support.processes import outcome, start_program
from support.run_programs import VERSIONS, begun, command_with
from support.study_files import study_file, tables_in

from bridge_demolition_addon.cli import ensemble
from bridge_demolition_addon.cli.main import main

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no signals")

RUNS = 16
DEEDS = ("nothing", "take time", "crash if shared", "crash", "fail", "refuse")


def start(study, output, log, *arguments, largest=0):
    """Start a study whose draws do what is drawn for them, and note in a log what they begin."""
    log.touch()
    return start_program("bda_ensemble", log, largest, "study", study, "--output", output, *arguments)


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    return study_file(tmp_path_factory.mktemp("study"), RUNS, DEEDS, seed=5)


@pytest.fixture(scope="module")
def undisturbed(study, tmp_path_factory):
    """Folder of the study as it is when nothing disturbs it, with one process."""
    folder = tmp_path_factory.mktemp("undisturbed")
    finish(study, folder / "out", folder / "log", jobs=1)
    return folder / "out"


def finish(study, output, log, jobs=2):
    """Run a study to its end, which nothing disturbs, in this process: what it printed."""
    log.touch()
    printed, complained = io.StringIO(), io.StringIO()
    engine = partial(ensemble.LocalProcesses, command=command_with(log), versions=VERSIONS)
    with redirect_stdout(printed), redirect_stderr(complained), pytest.MonkeyPatch.context() as patch:
        patch.setattr(ensemble, "LocalProcesses", engine)
        status = main(["study", str(study), "--output", str(output), "--jobs", str(jobs)])
    assert (status, complained.getvalue()) == (0, "")
    return printed.getvalue()


def wait_for_draws(process, output, count):
    while len(kept(output)) < count:
        assert process.poll() is None, process.communicate()
        time.sleep(0.005)


def kept(output):
    """Draws that are kept whole: one that is just being kept has its outcome in a folder of another name."""
    names = {path.parent.name for path in output.glob("draws/*/outcome.json")}
    return {name for name in names if not name.endswith(".part")}


def counted(log):
    """How often each draw was begun, by deed and seed."""
    return Counter(line.split(" ", 1)[1] for line in log.read_text(encoding="utf-8").splitlines())


def test_every_status_is_in_the_table(undisturbed):
    lines = (undisturbed / "runs.csv").read_text(encoding="utf-8").splitlines()
    assert [line.split(",")[0] for line in lines] == ["run", *map(str, range(1, RUNS + 1))]
    assert {line.split(",")[1] for line in lines[1:]} == {"done", "crashed", "failed", "refused"}
    said = json.loads((undisturbed / "study.json").read_text(encoding="utf-8"))
    assert said["reach"]["runs"] == RUNS and sum(said["statuses"].values()) == RUNS
    assert said["reach"]["unfinished"] == RUNS - said["statuses"]["done"]


def test_nothing_is_begun_once_more_but_what_shared_a_process(undisturbed):
    counts = counted(undisturbed.parent / "log")
    assert len(counts) == RUNS
    more = {draw.rsplit(" ", 1)[0] for draw, count in counts.items() if count > 1}
    assert more <= {"crash", "crash if shared"} and max(counts.values()) == 2


@pytest.mark.parametrize("jobs", long_but([2], [2, 5]))
def test_tables_are_the_same_with_any_number_of_jobs(study, undisturbed, tmp_path, jobs):
    finish(study, tmp_path / "out", tmp_path / "log", jobs)
    assert tables_in(tmp_path / "out") == tables_in(undisturbed)


@pytest.mark.parametrize(
    "number", long_but([signal.SIGINT], [signal.SIGINT, signal.SIGTERM, signal.SIGKILL]), ids=lambda number: number.name
)
def test_a_study_that_is_ended_goes_on(study, undisturbed, tmp_path, number):
    output, log = tmp_path / "out", tmp_path / "log"
    process = start(study, output, log, "--jobs", "2")
    wait_for_draws(process, output, 4)
    process.send_signal(number)
    status, _, complained = outcome(process)
    if number == signal.SIGKILL:
        assert (status, complained) == (-signal.SIGKILL, "")
    else:
        assert (status, complained) == (128 + number, "bda: interrupted\n")
        table = (output / "runs.csv").read_text(encoding="utf-8").splitlines()
        assert set(table[1:]) < set((undisturbed / "runs.csv").read_text(encoding="utf-8").splitlines())
    done = kept(output)
    assert 4 <= len(done) < RUNS
    wait_for_end_of(begun(log)[1])
    before = {address: (output / "draws" / address).stat().st_mtime_ns for address in done}

    finish(study, output, tmp_path / "second log")
    assert tables_in(output) == tables_in(undisturbed)
    assert before == {address: (output / "draws" / address).stat().st_mtime_ns for address in done}
    assert len(counted(tmp_path / "second log")) == RUNS - len(done)
    assert not list(output.glob("draws/*.part"))


def wait_for_end_of(processes):
    """Processes of draws end with their study, also where it was killed."""
    deadline = time.monotonic() + 20.0
    while any(is_alive(process) for process in set(processes)):
        assert time.monotonic() < deadline, "processes of draws outlive their study"
        time.sleep(0.05)


def is_alive(process):
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return "Z" not in (open(f"/proc/{process}/stat").read() if os.path.exists(f"/proc/{process}/stat") else "")


@pytest.mark.long
def test_a_process_that_is_killed_costs_nothing(study, undisturbed, tmp_path):
    output, log = tmp_path / "out", tmp_path / "log"
    process = start(study, output, log, "--jobs", "2")
    wait_for_draws(process, output, 3)
    while begun(log)[0][-1] != "take time":
        assert process.poll() is None
        time.sleep(0.001)
    os.kill(begun(log)[1][-1], signal.SIGKILL)
    status, _, complained = outcome(process)
    assert (status, complained) == (0, "")
    assert tables_in(output) == tables_in(undisturbed)


@pytest.mark.long
def test_what_was_killed_twice_is_a_row_and_is_run_again(tmp_path):
    study = study_file(tmp_path / "in", 6, ("nothing", "kill"), seed=1)
    output = tmp_path / "out"
    printed = finish(study, output, tmp_path / "log")
    killed = [line for line in (output / "runs.csv").read_text(encoding="utf-8").splitlines() if ",killed," in line]
    assert 0 < len(killed) < 6
    assert f"{len(killed)} of them were killed or had no memory: the same command makes these runs again" in printed
    finish(study, output, tmp_path / "second log")
    assert set(begun(tmp_path / "second log")[0]) == {"kill"}


@pytest.mark.long
def test_a_full_disk_ends_it_and_loses_nothing(tmp_path):
    study = study_file(tmp_path / "in", 12, ("nothing", "nothing", "write much"), seed=2)
    output, log = tmp_path / "out", tmp_path / "log"
    status, _, complained = outcome(start(study, output, log, "--jobs", "2", largest=100_000))
    assert status == 1
    assert ".part: File too large" in complained and len(complained.splitlines()) == 1
    done = kept(output)
    assert 0 < len(done) < 12
    assert not list(output.glob("draws/*.part"))
    finish(study, output, tmp_path / "second log")
    assert len(counted(tmp_path / "second log")) == 12 - len(done)
    whole = tmp_path / "whole"
    finish(study, whole, tmp_path / "third log")
    assert tables_in(output) == tables_in(whole)


def test_a_draw_that_is_damaged_is_run_again(study, undisturbed, tmp_path):
    output = tmp_path / "out"
    shutil.copytree(undisturbed, output)
    done = [path for path in sorted(output.glob("draws/*")) if '"done"' in (path / "outcome.json").read_text()]
    (done[0] / "outcome.json").write_text("{", encoding="utf-8")
    (done[1] / "outcome.json").unlink()
    finish(study, output, tmp_path / "log")
    assert sum(counted(tmp_path / "log").values()) == 2
    assert tables_in(output) == tables_in(undisturbed)


@pytest.mark.long
def test_two_at_once_are_refused(study, tmp_path):
    output = tmp_path / "out"
    first = start(study, output, tmp_path / "log", "--jobs", "1")
    wait_for_draws(first, output, 1)
    first.send_signal(signal.SIGSTOP)  # or it might be done before the second one looks
    status, _, complained = outcome(start(study, output, tmp_path / "second log"))
    first.send_signal(signal.SIGCONT)
    assert status == 2
    assert f"{output}: is being written to by process {first.pid} " in complained
    assert outcome(first)[0] == 0


@pytest.mark.long
def test_the_number_of_runs_may_be_raised_and_what_is_done_stays(tmp_path):
    output, few = tmp_path / "out", study_file(tmp_path / "in", 2, ("nothing", "fail"), seed=3)
    few.write_text(few.read_text(encoding="utf-8").replace("quantile = 0.5", "quantile = 0.8"), encoding="utf-8")
    printed = finish(few, output, tmp_path / "log")
    assert "Too few runs for a limit yet: it needs 4 runs, has 2." in printed
    assert json.loads((output / "study.json").read_text(encoding="utf-8"))["reach"]["runs_needed"] == 4
    first = (output / "runs.csv").read_text(encoding="utf-8").splitlines()[1:]
    few.write_text(few.read_text(encoding="utf-8").replace("runs = 2", "runs = 6"), encoding="utf-8")
    printed = finish(few, output, tmp_path / "second log")
    assert sum(counted(tmp_path / "second log").values()) == 4 and "Too few" not in printed
    rows = (output / "runs.csv").read_text(encoding="utf-8").splitlines()[1:]
    assert [row.split(",")[:5] for row in rows[:2]] == [row.split(",")[:5] for row in first] and len(rows) == 6
    assert "runs = 6" in (output / "study.toml").read_text(encoding="utf-8")
    finish(few, tmp_path / "whole", tmp_path / "third log")
    assert tables_in(output) == tables_in(tmp_path / "whole")
