# SPDX-License-Identifier: GPL-3.0-or-later
"""A study on a Dask cluster: a real scheduler with two workers, each a process, one of which is killed."""

import json
import os
import subprocess
import sys
import time
from contextlib import closing

import pytest
from support.checkout import ROOT
from support.processes import TIMEOUT_S, call_bda
from support.run_programs import VERSIONS, begun, program_in
from support.study_files import study_file, tables_in

from bridge_demolition_addon.errors import SimulationError
from bridge_demolition_addon.model.study.file import read_study
from bridge_demolition_addon.studies.dask_cluster import DaskCluster, put_returned
from bridge_demolition_addon.studies.engine import LocalProcesses
from bridge_demolition_addon.studies.run_process import RunLimits
from bridge_demolition_addon.studies.session import EnsembleSession

LIMITS = RunLimits(time_s=60.0)


class Cluster:
    """A scheduler, and workers that are killed when this is closed."""

    def __init__(self, folder):
        self._folder = folder
        known = folder / "scheduler.json"
        host = ("--host", "127.0.0.1", "--no-dashboard")
        self.scheduler = self._start("scheduler", *host, "--port", "0", "--scheduler-file", str(known))
        # The scheduler makes the file first and fills it then.
        wait_until(lambda: known.exists() and known.read_text(encoding="utf-8").endswith("\n}"))
        self.address = json.loads(known.read_text(encoding="utf-8"))["address"]
        self.workers = [
            self._start("worker", self.address, *host, "--nthreads", "1", "--no-nanny", "--name", str(number))
            for number in range(2)
        ]
        wait_until(lambda: self.thread_count() == 2)

    def thread_count(self):
        from distributed import Client

        with Client(self.address, set_as_default=False) as client:
            return sum(client.nthreads().values())

    def close(self):
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()

    def _start(self, what, *arguments):
        command = [sys.executable, "-m", f"distributed.cli.dask_{what}", *arguments]
        if what == "worker":
            command += ["--local-directory", str(self._folder)]
        return subprocess.Popen(
            command,
            cwd=ROOT,
            env=os.environ | {"PYTHONPATH": str(ROOT)},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )


def wait_until(is_so):
    deadline = time.monotonic() + TIMEOUT_S
    while not is_so():
        assert time.monotonic() < deadline
        time.sleep(0.02)


@pytest.fixture
def cluster(tmp_path):
    with closing(Cluster(tmp_path)) as cluster:
        yield cluster


def play(study, output, engine, each_step=lambda run: None):
    """Run a study to its end, and do something after each step."""
    run = EnsembleSession(study, output, engine)
    try:
        while not run.planner.is_finished:
            run.step(0.05)
            each_step(run)
        run.finish()
    finally:
        run.stop()


@pytest.mark.long
def test_a_worker_that_is_killed_costs_nothing(cluster, tmp_path):
    deeds = ("nothing", "take time", "crash", "refuse")
    study = read_study(study_file(tmp_path / "in", 10, deeds, seed=4))
    command, _ = program_in(tmp_path)
    play(study, tmp_path / "local", LocalProcesses(2, LIMITS, command, VERSIONS))

    (tmp_path / "far").mkdir()
    command, log = program_in(tmp_path / "far")
    killed = []

    def kill_in_the_middle(run):
        if not killed and run.planner.done >= 2 and begun(log)[0][-1] == "take time":
            killed.append(cluster.workers.pop())
            killed[0].kill()

    play(study, tmp_path / "cluster", DaskCluster(cluster.address, LIMITS, command, VERSIONS), kill_in_the_middle)
    assert killed and killed[0].wait() != 0
    assert cluster.thread_count() == 1
    assert tables_in(tmp_path / "cluster") == tables_in(tmp_path / "local")
    assert {path.name for path in (tmp_path / "cluster" / "draws").glob("*/*")} == {
        "begun.txt",
        "outcome.json",
        "outlines.npz",
    }


@pytest.mark.long
def test_a_study_whose_scheduler_goes_can_go_on_here(cluster, tmp_path):
    study = read_study(study_file(tmp_path / "in", 8, ("take time",), seed=4))
    command, log = program_in(tmp_path)

    def kill_scheduler(run):
        if run.planner.done == 3:
            cluster.scheduler.kill()

    engine = DaskCluster(cluster.address, LIMITS, command, VERSIONS)
    with pytest.raises(SimulationError, match="the scheduler has gone; once it is back, the same command goes on"):
        play(study, tmp_path / "out", engine, kill_scheduler)
    kept = len(list((tmp_path / "out" / "draws").glob("*/outcome.json")))
    assert 3 <= kept < 8
    wait_until(lambda: not (tmp_path / "out" / "run.lock").exists())
    log.write_text("", encoding="utf-8")
    play(study, tmp_path / "out", LocalProcesses(2, LIMITS, command, VERSIONS))
    assert len(begun(log)[0]) >= 8 - kept
    play(study, tmp_path / "whole", LocalProcesses(3, LIMITS, command, VERSIONS))
    assert tables_in(tmp_path / "out") == tables_in(tmp_path / "whole")


def test_a_worker_keeps_its_process_from_run_to_run(cluster, tmp_path):
    study = read_study(study_file(tmp_path / "in", 8, ("nothing",), seed=4))
    command, log = program_in(tmp_path)
    play(study, tmp_path / "out", DaskCluster(cluster.address, LIMITS, command, VERSIONS))
    deeds, processes = begun(log)
    assert len(deeds) == 8
    assert len(set(processes)) <= 2  # workers, each with one thread


@pytest.mark.long
def test_blender_runs_on_the_workers(cluster, tmp_path, capsys):
    study = study_file(tmp_path / "in", 1, ("One",))
    far = ("study", study, "--output", tmp_path / "far", "--dask", cluster.address, "--quiet")
    assert call_bda(capsys, *far) == (0, "", "")
    assert call_bda(capsys, "study", study, "--output", tmp_path / "near", "--quiet") == (0, "", "")
    assert tables_in(tmp_path / "far") == tables_in(tmp_path / "near")
    assert len(list((tmp_path / "far").glob("draws/*/outlines.npz"))) == 1


@pytest.mark.parametrize("name", ["../outside.txt", "/outside.txt", "frames/../../outside.txt", "link/outside.txt"])
def test_no_file_of_a_worker_is_written_outside_of_the_run_s_folder(tmp_path, name):
    folder = tmp_path / "run_00001"
    folder.mkdir()
    (folder / "kept.txt").write_text("of before")
    (folder / "link").symlink_to(tmp_path, target_is_directory=True)
    with pytest.raises(
        SimulationError, match=r"tcp://there: a worker returned a file '.*outside.txt': do not trust it"
    ):
        put_returned(folder, {"summary.json": b"{}", name: b"x"}, "tcp://there")
    assert [path.name for path in tmp_path.iterdir()] == ["run_00001"]
    assert (folder / "kept.txt").read_text() == "of before"
    put_returned(folder, {"summary.json": b"{}", "frames/1.png": b"x"}, "tcp://there")
    assert sorted(path.name for path in folder.rglob("*")) == ["1.png", "frames", "summary.json"]
