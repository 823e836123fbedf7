# SPDX-License-Identifier: GPL-3.0-or-later
"""What every test can ask for: Blender, the extension in it, and a process that ends whatever Blender's state."""

import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import build_core
import pytest
from support.processes import end_started

import bridge_demolition_addon
from bridge_demolition_addon.cli.console import end_process

# Asserts that stand outside of test files say what they compared, too.
pytest.register_assert_rewrite("support.falling_pair", "support.example_claims")

_session = pytest.StashKey[pytest.Session]()
_user_folder = pytest.StashKey[str]()


@pytest.fixture(autouse=True)
def _nothing_is_left_running() -> Iterator[None]:
    """End the processes that a test started, which it may have left running as it failed."""
    yield
    end_started()


@pytest.fixture
def blender() -> Iterator[ModuleType]:
    """The bpy module, with an empty factory scene; what the test left behind is gone afterwards."""
    import bpy

    # Without the preferences, which would switch all of Blender's own add-ons off and on: five times as fast.
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    yield bpy
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)


@pytest.fixture
def extension(blender: ModuleType) -> Iterator[ModuleType]:
    """The bpy module with an empty scene and the extension switched on."""
    bridge_demolition_addon.register()
    yield blender
    bridge_demolition_addon.unregister()


@pytest.fixture
def settings(extension: ModuleType):
    """The extension's settings of the scene."""
    return extension.context.scene.bda


_LONGEST = (
    "test_release",  # which builds what test_extension looks at later
    "test_foreign_files",
    "test_beginnings",
    "test_validation",
    "test_nothing_is_missing",
    "test_core_build",
    "test_cli_lossless",
    "test_tutorials",
    "test_cli_study",
    "test_benches",
    "test_search",
    "test_core_fuzz",
    "test_cli_check",
    "test_i235",
    "test_changed_in_blender",
    "test_reinforced_cracks",
    "test_picks",
    "test_cli_streams",
    "test_bridges_as_they_are",
    "test_make_report",
    "test_span_lifted_out",
    "test_optimise",
    "test_same_bits",
    "test_readme",
    "test_cli_run_comparison",
    "test_same_run",
    "test_explosives",
    "test_three_span_box_girder",
    "test_drilled_columns",
    "test_ensemble_versions",
    "test_pybullet",
    "test_deleting",
    "test_preview_process",
)
"""Files that take longest, the longest first: no process is left alone with one of them at the end."""

_SLOW = ("examples", "studies", "simulation", "model", "cli", "report", "ui", "ifc", "extension")
"""Folders whose files take longest, and come after these: at the end all processes have short ones."""

_QUICK = ("engineering", "model", "charts", "display", "system")
"""Folders of those tests that `--quick` leaves: none needs a run in Blender, as few of these are quick."""

_QUICK_FILES = ("test_words", "test_docs", "test_architecture", "test_licence", "test_private_names", "test_version")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--quick", action="store_true", help="only what takes a minute: before a commit")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    def rank(item: pytest.Item) -> int:
        if item.path.stem in _LONGEST:
            return _LONGEST.index(item.path.stem)
        folder = item.path.relative_to(config.rootpath / "tests").parts[0]
        return len(_LONGEST) + (_SLOW.index(folder) if folder in _SLOW else len(_SLOW))

    items.sort(key=rank)
    if config.getoption("quick"):
        left_out = [item for item in items if _is_slow(item)]
        config.hook.pytest_deselected(items=left_out)
        gone = set(left_out)
        items[:] = [item for item in items if item not in gone]


def _is_slow(item: pytest.Item) -> bool:
    """Whether `--quick` leaves a test out."""
    return "blender" in item.fixturenames or any(item.get_closest_marker(name) for name in ("slow", "long"))


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """With `--quick`, do not even load the files that it leaves out."""
    if not config.getoption("quick") or collection_path.suffix != ".py":
        return None
    place = collection_path.relative_to(config.rootpath / "tests")
    return None if place.parts[0] in _QUICK or place.stem in (*_QUICK_FILES, "conftest") else True


def pytest_configure(config: pytest.Config) -> None:
    # Blender reads this once, when bpy is imported. A person's own preferences and add-ons must
    # neither change a test nor be changed by one.
    config.stash[_user_folder] = os.environ["BLENDER_USER_RESOURCES"] = tempfile.mkdtemp(prefix="bda-tests-")

    if not hasattr(config, "workerinput"):  # once, and not in each process of pytest-xdist
        build_core.update()


def pytest_sessionstart(session: pytest.Session) -> None:
    session.config.stash[_session] = session


@pytest.hookimpl(trylast=True)
def pytest_unconfigure(config: pytest.Config) -> None:
    """Leave at once when Blender lives in this process.

    The bpy module may hang (4.5) or crash (4.2) in the interpreter's exit when a handler is still
    registered, as it is after a failed test: pytest's verdict would be lost. By now the summary is
    printed, and the other plugins have cleaned up, so nothing is skipped. With pytest-xdist the same
    holds for each worker, which has sent its results before it gets here.
    """
    shutil.rmtree(config.stash[_user_folder], ignore_errors=True)
    session = config.stash.get(_session, None)
    if session is not None and "bpy" in sys.modules:
        sys.stdout.flush()
        sys.stderr.flush()
        end_process(int(session.exitstatus))
