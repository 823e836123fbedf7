# SPDX-License-Identifier: GPL-3.0-or-later
"""Do a person's job in a real Blender with a window, by mouse and keyboard, and judge what comes of it.

Started by scripts/gui_test; pytest has no part in it, and finds no tests here, as it takes minutes and a Blender with
a screen. Every job (job_*.py beside this file) gets a Blender of its own, with the extension installed from its zip.
Of each stay, in the output folder, screenshots, what Blender wrote to the console, and what was checked. The exit
status is 0 where everything was as it should be.

A new job is a file job_NAME.py with a generator steps(person), written with what person.py and habits.py offer.
"""

import argparse
import importlib.machinery
import importlib.util
import json
import re
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from types import ModuleType

from machine import CHECKOUT, DebianRoot, SetupError, System, debian_root, found_system
from upheavals import ALONE, RECORDED, UPHEAVALS, WATCHED
from upheavals import job as upheaval_job

HERE = Path(__file__).resolve().parent
JOBS = tuple(
    sorted({path.stem.removeprefix("job_") for path in HERE.glob("job_*.py")} - {"upheaval"})
    + [upheaval_job(upheaval, company) for upheaval in UPHEAVALS for company in (RECORDED, WATCHED)]
)
REPEATED = (*JOBS, *(upheaval_job(upheaval, ALONE) for upheaval in UPHEAVALS))
"""Those that may crash for Blender's own sake are not part of a run of all."""
JOB_SECONDS = 3600
"""On a machine that has other work: the longest takes some minutes alone."""

PICTURES = "pictures"
"""Folder of a job's pictures for the walk-through."""

LIBRARIES = {"import": ("ifcopenshell", "lark", "shapely", "typing_extensions")}
"""What another extension would have brought for a job."""
LIBRARY_TAGS = ("manylinux_2_31_x86_64", "manylinux_2_28_x86_64", "manylinux2014_x86_64")
"""Systems that its wheels are for."""

ENDED_BY_SIGNAL = 128
"""Exit statuses above this one are signals."""

LOG_PREFIX = re.compile(r"\d+:\d\d\.\d{3}  \S+ +\| ")
"""What Blender 5 begins its lines with: time and category."""

EXPECTED_ON_CONSOLE = re.compile(
    r"$"
    r"|Blender \d+\.\d+"
    r"|Blender quit$"
    r"|(Info: )?Saved (as |session recovery to )?\""
    r"|(WARNING )?[Cc]ould not get a list of mounted file-systems$"
    r"|Read blend: "
    r"|Saved: '"
    r"|Time: \d+:\d\d\.\d\d \(Saving: "
    r"|(Video )?[Aa]ppend frame \d+"
    r"|(Info: )?Deleted \d+ object"
    r"|(Info|Warning|Error): (30 shards, |Recording to |Stopped after |Baked: |\d+ clouds of dust)"
    r"|(Info|Warning|Error): (The recording ended early|Results are in|4 stages, with tables in )"
    r"|Warning: (Changed in Blender, and not in the scenario of the run|The bridge does not stand by itself)"
    r"|(Scene: |Warning: Not as it was built: )\d+ (shards?|body|bodies) (is|are) (moved|missing|added)"
    r"|(Scene: |Warning: Not as it was built: )the \w+ of the scenario is missing"
    r"|Scene: \d+ connections? (fewer|more) than built"
    r"|Info: (\d+ force fields made|\d+ members added from the selected meshes)"
    r"|Warning: \d+ shards? creeps? "
)
"""Lines that Blender writes as it goes, and reports of operators that a job calls."""


def main() -> int:
    options = parse()
    try:
        return do_jobs(options)
    except SetupError as error:
        print(f"gui_test: {error}", file=sys.stderr)
        return 1


def do_jobs(options: argparse.Namespace) -> int:
    """Make Blender ready with the extension, and do the jobs in it; the exit status."""
    machine = found_system(options.blender) if not options.root else None
    machine = machine or debian_root(options.root or CHECKOUT / "build" / "gui_test" / options.suite, options.suite)
    output = emptied(options.output.resolve())
    install(machine, build(machine, output), output)
    jobs = options.job or JOBS
    if options.repeat > 1:
        failures = sum([repeat_job(machine, output, job, options.repeat) for job in jobs])
    else:
        failures = sum([run_job(machine, output, job) for job in jobs])
    if options.pictures and not failures:
        keep_pictures(output, jobs, options.pictures)
    print(f"{failures} failed" if failures else "all as it should be", f"- screenshots and logs are in {output}")
    return 1 if failures else 0


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="gui_test", description=__doc__.splitlines()[0])
    parser.add_argument("--blender", metavar="PATH", help="the Blender to use, 4.2 or later (the one on the PATH)")
    parser.add_argument(
        "--root",
        type=lambda path: Path(path).resolve(),
        metavar="DIR",
        help="folder with a Debian to run Blender in, made there if missing; needs root (build/gui_test/SUITE, where "
        "there is no other Blender)",
    )
    parser.add_argument(
        "--suite", default="trixie", help="the Debian to make: trixie for Blender 4.3, unstable for 5.2"
    )
    parser.add_argument(
        "--output", type=Path, default=CHECKOUT / "runs" / "gui_test", metavar="DIR", help="where it goes"
    )
    parser.add_argument(
        "--job", action="append", choices=REPEATED, metavar="NAME", help="only this job; may be repeated"
    )
    parser.add_argument(
        "--repeat", type=int, default=1, metavar="N", help="do every job so often, and count how often Blender crashes"
    )
    parser.add_argument(
        "--pictures",
        type=Path,
        metavar="DIR",
        help="copy the pictures that the jobs make for the walk-through there, if everything was as it should be",
    )
    return parser.parse_args()


def emptied(folder: Path) -> Path:
    """The output folder, cleared of an earlier run's jobs and of nothing else."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("home", "user", "extension", *REPEATED):
        make_empty(folder / name)
    return folder


def make_empty(folder: Path) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()


def keep_pictures(output: Path, jobs: Sequence[str], folder: Path) -> None:
    """Copy the pictures that jobs made for the walk-through."""
    folder.mkdir(parents=True, exist_ok=True)
    for job in jobs:
        for picture in (output / job / PICTURES).glob("*.png"):
            shutil.copyfile(picture, folder / picture.name)


def build(machine: System | DebianRoot, output: Path) -> Path:
    """The extension's zip for the Python and the numpy of that Blender, whatever series they make."""
    python, numpy = versions_of(machine, output)
    builder = build_extension()
    known = builder.SERIES.get(python) or builder.Series("", python, numpy, "", None, ())
    series = replace(known, name="gui-test", blender_min="4.2.0", blender_max=None, platforms=("linux-x64",))
    options = argparse.Namespace(platform=None, split_platforms=False, output=output / "extension")
    failures: list[Exception] = []
    try:
        archives = builder.build(series, options, builder.BuildTool.of_bpy(), failures)
    except builder.BuildError as error:
        failures.append(error)
    if failures:
        raise SetupError("; ".join(map(str, failures)))
    return archives[0]


def versions_of(machine: System | DebianRoot, output: Path) -> tuple[str, str]:
    """The Python and the numpy of that Blender."""
    question = "import sys, numpy; print('versions %d.%d' % sys.version_info[:2], numpy.__version__)"
    answer = blender(machine, output, "--background", "--factory-startup", "--python-expr", question)
    versions = re.search(r"^versions (\S+) (\S+)$", answer.stdout, re.MULTILINE)
    if not versions:
        raise SetupError(f"{machine.blender} does not start:\n{answer.stdout}{answer.stderr}")
    return versions.groups()


def build_extension() -> ModuleType:
    """The script of that name as a module."""
    loader = importlib.machinery.SourceFileLoader("build_extension", str(CHECKOUT / "scripts" / "build_extension"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    sys.modules[loader.name] = module
    loader.exec_module(module)
    return module


def install(machine: System | DebianRoot, archive: Path, output: Path) -> None:
    """Install and switch on the extension, as its README says."""
    arguments = ("--command", "extension", "install-file", "-r", "user_default", "-e", str(archive))
    result = blender(machine, output, *arguments)
    if result.returncode or "Error" in result.stdout + result.stderr:
        raise SetupError(f"Blender could not install the extension:\n{result.stdout}{result.stderr}")


def blender(machine: System | DebianRoot, output: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run Blender without a window."""
    command = machine.command(machine.blender, *arguments, output=output)
    return subprocess.run(command, env=environment(output), capture_output=True, text=True)


def environment(output: Path) -> dict[str, str]:
    """Nothing of the person's own settings and packages."""
    return {
        "PATH": f"{HERE / 'programs'}:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin",
        "LANG": "C.UTF-8",
        "HOME": str(output / "home"),
        "TMPDIR": str(output / "home"),
        "BLENDER_USER_RESOURCES": str(output / "user"),
        "LIBGL_ALWAYS_SOFTWARE": "1",
        "PYTHONDONTWRITEBYTECODE": "1",
    }


def run_job(machine: System | DebianRoot, output: Path, job: str) -> int:
    """Do one job, print what was checked, and return how much was not as it should be."""
    print(f"== {job}", flush=True)
    _, checks = do(machine, output, job, output / job)
    for what, trouble in checks:
        print(f"FAILED  {what}: {trouble}" if trouble else f"ok      {what}", flush=True)
    return sum(bool(trouble) for _, trouble in checks)


def repeat_job(machine: System | DebianRoot, output: Path, job: str, times: int) -> int:
    """Do one job again and again, print how often Blender crashed, and return how often something went wrong."""
    crashes, survived, failures, wrong = 0, 0, 0, Counter()
    for number in range(1, times + 1):
        folder = output / job / f"{number:02}"
        folder.mkdir()
        status, checks = do(machine, output, job, folder)
        troubles = [f"{what}: {trouble}" for what, trouble in checks if trouble]
        crashes += status > ENDED_BY_SIGNAL
        failures += bool(troubles)
        survived += sum(what.startswith("survived") for what, _ in checks)
        if status <= ENDED_BY_SIGNAL:
            wrong.update(troubles)
    often = f", which survived {survived} times of it" if survived else ""
    print(f"{job}: {crashes} of {times} Blenders crashed{often}; in {failures - crashes} something else was wrong")
    for trouble, count in wrong.items():
        print(f"  {count} times {trouble}")
    sys.stdout.flush()
    return failures


def window_size(job: str) -> tuple[str, str]:
    """Small where nothing is clicked, as it is drawn without a graphics card."""
    return ("640", "480") if job.startswith("upheaval") else ("1280", "800")


def do(machine: System | DebianRoot, output: Path, job: str, folder: Path) -> tuple[int, list[tuple[str, str]]]:
    """Do one job; Blender's exit status, and what was checked with what was wrong with it.

    The home is empty at first: the results of another job are kept there.
    """
    make_empty(output / "home")
    if job in LIBRARIES:
        bring_libraries(LIBRARIES[job], versions_of(machine, output)[0], folder / "libraries")
    window = ("--enable-event-simulate", "--gpu-backend", "opengl", "--window-geometry", "0", "0", *window_size(job))
    driven = ("--python", str(HERE / "drive.py"), "--", job, str(folder))
    session = ("python3", str(HERE / "session.py"), str(JOB_SECONDS), machine.blender, *window, *driven)
    with (folder / "console.txt").open("w") as console:
        command = machine.command(*session, output=output)
        status = subprocess.run(command, env=environment(output), stdout=console, stderr=subprocess.STDOUT).returncode
    checks = [*checked(folder), ("Blender ends by itself and in peace", "" if status == 0 else f"exit status {status}")]
    checks += [("console", f"unexpected: {line}") for line in unexpected(folder)]
    return status, checks


def bring_libraries(names: Sequence[str], python: str, folder: Path) -> None:
    """Put libraries for a Python, which need not be the one that this runs with, into a folder."""
    command = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--only-binary=:all:"]
    command += [f"--python-version={python}", *(f"--platform={tag}" for tag in LIBRARY_TAGS), f"--target={folder}"]
    result = subprocess.run([*command, *names], capture_output=True, text=True)
    if result.returncode:
        raise SetupError(f"pip could not install {', '.join(names)} for Python {python}:\n{result.stderr.strip()}")


def checked(folder: Path) -> list[tuple[str, str]]:
    """What the job checked: each thing, and what was wrong with it."""
    file = folder / "checks.jsonl"
    checks = (
        [tuple(json.loads(line)) for line in file.read_text(encoding="utf-8").splitlines()] if file.exists() else []
    )
    return checks if ("done", "") in checks else [*checks, ("the job is done to its end", "it is not")]


def unexpected(folder: Path) -> list[str]:
    """Lines on the console that neither Blender writes as it goes, nor repeat what a job has seen reported."""
    reports = folder / "reports.txt"
    seen = reports.read_text(encoding="utf-8").splitlines() if reports.exists() else []
    repeated = {
        level + report for level in ("", "Info: ", "Warning: ", "Error: ", "WARNING ", "ERROR ") for report in seen
    }
    text = (folder / "console.txt").read_text(encoding="utf-8", errors="replace")
    lines = [LOG_PREFIX.sub("", line) for line in text.splitlines()]
    return [line for line in lines if line not in repeated and not EXPECTED_ON_CONSOLE.match(line)]


if __name__ == "__main__":
    sys.exit(main())
