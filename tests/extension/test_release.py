# SPDX-License-Identifier: GPL-3.0-or-later
"""A release as it is handed out: what it is built from, its files and checksums, and Blender installing from it."""

import hashlib
import json
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path
from typing import Any

import build_core
import pytest
import release
from support.bare_blender import run_bare
from support.checkout import ROOT

from bridge_demolition_addon.version import VERSION

NEXT = "99.0.0"
"""A version after any that this will have."""

PLATFORM = {"linux": "linux-x64", "darwin": "macos-arm64", "win32": "windows-x64"}[sys.platform]
PYTHON = "{}.{}".format(*sys.version_info)
COPIED = ("bridge_demolition_addon", "core", "examples", "scripts", "docs/pictures/walkthrough")
COPIED_FILES = ("blender_manifest.toml", "pyproject.toml", "README.md", "LICENSE", "docs/walkthrough.md")


@pytest.fixture(scope="module")
def listed(built: Path) -> list[dict[str, Any]]:
    """The zips that Blender is offered."""
    return json.loads((built / "index.json").read_text(encoding="utf-8"))["data"]


@pytest.fixture(scope="module")
def next_built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The repository of a later version, with the zip for this Python and system."""
    checkout = tmp_path_factory.mktemp("checkout")
    for name in COPIED:
        shutil.copytree(ROOT / name, checkout / name, ignore=shutil.ignore_patterns("__pycache__"))
    for name in COPIED_FILES:
        shutil.copy(ROOT / name, checkout / name)
    for name in ("blender_manifest.toml", "bridge_demolition_addon/version.py"):
        text = (checkout / name).read_text(encoding="utf-8")
        (checkout / name).write_text(text.replace(f'"{VERSION}"', f'"{NEXT}"'), encoding="utf-8")
    # Wheels that are here already are not downloaded again.
    (ROOT / "build" / "wheels").mkdir(parents=True, exist_ok=True)
    (checkout / "build").symlink_to(ROOT / "build", target_is_directory=True)
    output = tmp_path_factory.mktemp("next")
    command = [sys.executable, checkout / "scripts" / "build_extension", "--repository", "--output", output]
    subprocess.run([*command, "--python", PYTHON, "--platform", PLATFORM, "--split-platforms"], check=True)
    return output


@pytest.mark.long
def test_checksums_are_those_of_all_files(built: Path) -> None:
    lines = (built / "SHA256SUMS").read_text(encoding="ascii").splitlines()
    stated = dict(reversed(line.split("  ")) for line in lines)
    assert stated == {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest()
        for path in built.iterdir()
        if path.name != "SHA256SUMS"
    }


@pytest.mark.long
def test_index_lists_each_zip_with_its_system_and_version(built: Path, listed: list[dict[str, Any]]) -> None:
    assert {item["archive_url"] for item in listed} == {f"./{path.name}" for path in built.glob("*.zip")}
    for item in listed:
        archive = built / item["archive_url"]
        assert (item["version"], item["platforms"]) == (VERSION, [PLATFORM])
        assert item["archive_size"] == archive.stat().st_size
        assert item["archive_hash"] == "sha256:" + hashlib.sha256(archive.read_bytes()).hexdigest()


@pytest.mark.long
@pytest.mark.skipif(sys.platform != "linux", reason="Blenders with Python 3.14 are those of Debian")
@pytest.mark.parametrize(
    ("blender", "python"),
    # What each Blender brings, by its release notes; the last is that of Debian, with the Python of the system.
    [((4, 2, 0), "3.11"), ((5, 0, 1), "3.11"), ((5, 1, 0), "3.13"), ((5, 2, 0), "3.13"), ((5, 2, 0), "3.14")],
)
def test_each_blender_is_offered_one_zip(listed: list[dict[str, Any]], blender: tuple[int, ...], python: str) -> None:
    fitting = [item for item in listed if fits(item, blender) and item["python_versions"] == [python]]
    assert len(fitting) == 1
    if blender < (4, 3):  # which may not look at the Python
        assert fitting == [item for item in listed if fits(item, blender)]


def fits(item: dict[str, Any], blender: tuple[int, ...]) -> bool:
    """Whether a zip is for a version of Blender: the newest is excluded."""
    oldest, newest = (item.get(f"blender_version_{end}") for end in ("min", "max"))
    return parts(oldest) <= blender and (newest is None or blender < parts(newest))


def parts(version: str) -> tuple[int, ...]:
    """Return the numbers of a version."""
    return tuple(map(int, version.split(".")))


@pytest.mark.long
def test_packages_hold_all_of_the_package_and_the_licence(built: Path) -> None:
    tracked = subprocess.run(
        ["git", "-C", ROOT, "ls-files", "bridge_demolition_addon/*.py", "bridge_demolition_addon/*.toml"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    platform = build_core.PLATFORMS[PLATFORM]
    wheel = built / f"bridge_demolition_addon-{VERSION}-py3-none-{platform.tag}.whl"
    assert [*built.glob("*.whl")] == [wheel]
    names = set(zipfile.ZipFile(wheel).namelist())
    assert f"bridge_demolition_addon/engineering/core/{platform.library}" in names
    assert names >= set(tracked)
    assert f"bridge_demolition_addon-{VERSION}.dist-info/licenses/LICENSE" in names
    with tarfile.open(built / f"bridge_demolition_addon-{VERSION}.tar.gz") as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    of_core = {f"core/{path.relative_to(ROOT / 'core').as_posix()}" for path in build_core.SOURCES.iterdir()}
    assert names >= {*tracked, *of_core, "core/backend.py", "LICENSE", "pyproject.toml", "README.md"}
    assert not [name for name in names if Path(name).name == platform.library]
    assert not [name for name in names if name.startswith("tests")]


@pytest.mark.long
def test_blender_installs_and_updates_from_the_folder(built: Path, next_built: Path, tmp_path: Path) -> None:
    result = tmp_path / "record.json"
    program = Path(__file__).with_name("install_and_update.py")
    packages = tmp_path / "packages"
    packages.mkdir()
    run_bare(program, tmp_path / "user", packages, tmp_path / "served", built, next_built, result)
    record = json.loads(result.read_text(encoding="utf-8"))
    assert record["installed"] == {"version": VERSION, "enabled": True, "runs": VERSION}
    assert record["updated"] == {"version": NEXT, "enabled": True, "runs": NEXT}


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """A checkout of one commit, which has the tag v1.2.0."""
    folder = tmp_path / "checkout"
    folder.mkdir()
    (folder / "CHANGELOG.md").write_text("# Changelog\n\n## Unreleased\n\n## 1.2.0 - 2026-01-31\n", encoding="utf-8")
    git(folder, "init", "--quiet")
    commit(folder, "first")
    git(folder, "tag", "v1.2.0")
    return folder


def commit(folder: Path, message: str) -> None:
    git(folder, "add", "--all")
    author = ("-c", "user.name=Somebody", "-c", "user.email=somebody@example.org")
    git(folder, *author, "commit", "--quiet", "--allow-empty", "--message", message)


def git(folder: Path, *arguments: str) -> None:
    subprocess.run(["git", "-C", folder, *arguments], check=True)


def refusal(folder: Path, version: str) -> str:
    with pytest.raises(release.ReleaseError) as refused:
        release.refuse_what_is_not_tagged(folder, version)
    return str(refused.value)


def test_the_tagged_commit_is_released(repository: Path) -> None:
    release.refuse_what_is_not_tagged(repository, "1.2.0")


def test_a_tag_with_a_message_is_as_good(repository: Path) -> None:
    git(
        repository,
        "-c",
        "user.name=Somebody",
        "-c",
        "user.email=somebody@example.org",
        "tag",
        "--force",
        "--annotate",
        "--message=second of the year",
        "v1.2.0",
    )
    release.refuse_what_is_not_tagged(repository, "1.2.0")


def test_what_is_not_committed_is_named(repository: Path) -> None:
    (repository / "notes").touch()
    assert refusal(repository, "1.2.0") == "notes is not committed: commit, or use --draft"
    for name in ("a", "b", "c"):
        (repository / name).touch()
    assert refusal(repository, "1.2.0") == "a, b, c and 1 more are not committed: commit, or use --draft"


def test_a_missing_tag_is_named(repository: Path) -> None:
    assert refusal(repository, "1.3.0") == "no commit has the tag v1.3.0: use git tag --annotate v1.3.0, or --draft"


def test_a_tag_of_another_commit_is_named(repository: Path) -> None:
    commit(repository, "second")
    said = re.fullmatch(
        r"v1\.2\.0 is commit (\w{8}), and this is (\w{8}): use git checkout v1\.2\.0, or --draft",
        refusal(repository, "1.2.0"),
    )
    assert said and said[1] != said[2]


def test_a_release_has_a_section_in_the_changelog(repository: Path) -> None:
    git(repository, "tag", "v1.3.0")
    assert refusal(repository, "1.3.0").startswith("CHANGELOG.md has no section 1.3.0: ")


def test_a_folder_without_git_is_refused(tmp_path: Path) -> None:
    assert refusal(tmp_path, "1.2.0").startswith("git status says: ")


@pytest.mark.parametrize("is_translated", [True, False])
def test_a_release_refuses_what_only_warns_elsewhere(tmp_path: Path, is_translated: bool) -> None:
    for name in release.TRANSLATIONS:
        (tmp_path / name).parent.mkdir(parents=True)
        asked = f"import os\n\ndef test_texts():\n    assert os.environ['BDA_RELEASE'] and {is_translated}\n"
        (tmp_path / name).write_text(asked, encoding="utf-8")
    if is_translated:
        release.refuse_what_is_not_translated(tmp_path)
    else:
        with pytest.raises(release.ReleaseError, match="texts lack translations"):
            release.refuse_what_is_not_translated(tmp_path)


def test_part_of_the_systems_is_no_release(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        release.main(["--platform", "linux-x64"])
    assert "--platform is for a draft" in capsys.readouterr().err
