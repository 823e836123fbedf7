# SPDX-License-Identifier: GPL-3.0-or-later
"""Build a release into dist/VERSION: wheel, source distribution, the extension's zips, their index, and checksums.

The folder is a repository of extensions: Blender installs and updates from its `index.json`, on a disk or on a server.
A release is what its tag says: the commit `vVERSION` and nothing else.
"""

import argparse
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(Path(__file__).resolve().parent.parent / "core"))

import build_core

from bridge_demolition_addon.version import VERSION

ROOT = Path(__file__).resolve().parent.parent

SOURCES = ("bridge_demolition_addon", "core", "LICENSE", "MANIFEST.in", "README.md", "pyproject.toml")
"""What the package is built from."""

TRANSLATIONS = ("tests/report/languages/test_nothing_is_missing.py", "tests/ui/languages/test_tables.py")
"""Tests that find texts without a translation: elsewhere they only warn."""

CHECKSUMS = "SHA256SUMS"
SHOWN = 3
"""Changed files that a message names."""


class ReleaseError(Exception):
    """There is no release; the message says why."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Build what is asked for; the exit status."""
    options = parse(arguments)
    folder = options.output / (f"{VERSION}-draft" if options.draft else VERSION)
    try:
        if not options.draft:
            refuse_what_is_not_tagged(ROOT, VERSION)
            refuse_what_is_not_translated(ROOT)
        elif folder.exists():
            shutil.rmtree(folder)
        build(folder, options.platform)
    except (ReleaseError, build_core.BuildError) as error:
        print(f"release: {error}", file=sys.stderr)
        return 1
    print(f"In Blender: Preferences, Get Extensions, Repositories, +, Add Remote Repository: {index_url(folder)}")
    return 0


def parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(prog="release", description=__doc__.splitlines()[0])
    parser.add_argument("--draft", action="store_true", help="build the files as they are, into VERSION-draft")
    parser.add_argument("--output", type=Path, default=ROOT / "dist", metavar="DIR", help="folder of releases (dist)")
    parser.add_argument(
        "--platform",
        action="append",
        default=[],
        metavar="NAME",
        help="in a draft: only for this system, such as linux-x64; may be repeated",
    )
    options = parser.parse_args(arguments)
    if options.platform and not options.draft:
        parser.error("--platform is for a draft: a release has the zips of all systems")
    return options


def refuse_what_is_not_tagged(root: Path, version: str) -> None:
    """Raise if the checkout is another than the commit with the tag of this version."""
    tag = f"v{version}"
    if changed := git(root, "status", "--porcelain").splitlines():
        names = ", ".join(line[3:] for line in changed[:SHOWN])
        more = f" and {len(changed) - SHOWN} more" if len(changed) > SHOWN else ""
        raise ReleaseError(
            f"{names}{more} {'is' if len(changed) == 1 else 'are'} not committed: commit, or use --draft"
        )
    head = git(root, "rev-parse", "HEAD")
    tagged = git(
        root,
        "for-each-ref",
        "--format=%(if)%(*objectname)%(then)%(*objectname)%(else)%(objectname)%(end)",
        f"refs/tags/{tag}",
    )
    if not tagged:
        raise ReleaseError(f"no commit has the tag {tag}: use git tag --annotate {tag}, or --draft")
    if tagged != head:
        raise ReleaseError(f"{tag} is commit {tagged[:8]}, and this is {head[:8]}: use git checkout {tag}, or --draft")
    if f"\n## {version} " not in (root / "CHANGELOG.md").read_text(encoding="utf-8"):
        raise ReleaseError(f"CHANGELOG.md has no section {version}: expected a line such as ## {version} - 2026-01-31")


def refuse_what_is_not_translated(root: Path) -> None:
    """Raise if a text of reports or of the window has no translation in one of the languages."""
    command = (sys.executable, "-m", "pytest", "-q", *TRANSLATIONS)
    done = subprocess.run(command, cwd=root, env=os.environ | {"BDA_RELEASE": "1"}, capture_output=True, text=True)
    if done.returncode:
        raise ReleaseError(f"texts lack translations, or cannot be compared with them:\n{done.stdout}{done.stderr}")


def git(root: Path, *arguments: str) -> str:
    """Return what git prints."""
    try:
        done = subprocess.run(["git", "-C", root, *arguments], capture_output=True, text=True, check=True)
    except FileNotFoundError:
        raise ReleaseError("git is not installed: install it, or use --draft") from None
    except subprocess.CalledProcessError as error:
        raise ReleaseError(f"git {arguments[0]} says: {error.stderr.strip()}") from error
    return done.stdout.rstrip()


def build(folder: Path, platforms: Sequence[str]) -> None:
    """Build all files of a release into a folder, which is new, and is gone again where anything fails."""
    if folder.exists():
        raise ReleaseError(f"{folder} is there already: remove it first")
    folder.mkdir(parents=True)
    try:
        build_packages(folder, platforms or list(build_core.PLATFORMS))
        build_repository(folder, platforms)
        write_checksums(folder)
    except BaseException:
        shutil.rmtree(folder)
        raise


def build_packages(folder: Path, platforms: Sequence[str]) -> None:
    """Build the source distribution, and from it a wheel for each system, which holds the compiled core."""
    with tempfile.TemporaryDirectory(prefix="bda-release-") as name:
        # A copy: nothing that an earlier build left in the checkout comes along.
        copy, built = Path(name, "source"), Path(name, "built")
        copy.mkdir()
        for source in SOURCES:
            if (ROOT / source).is_dir():
                ignored = shutil.ignore_patterns("__pycache__", "bda_core.*")
                shutil.copytree(ROOT / source, copy / source, ignore=ignored)
            else:
                shutil.copy(ROOT / source, copy)
        uv_build("--sdist", f"--out-dir={built}", copy)
        (source,) = built.glob("*.tar.gz")
        for platform in platforms:
            library = build_core.kept(build_core.PLATFORMS[platform])
            settings = (f"--config-setting=platform={platform}", f"--config-setting=library={library}")
            uv_build("--wheel", f"--out-dir={built}", *settings, source)
        for package in (source, *sorted(built.glob("*.whl"))):
            print(shutil.copy(package, folder), flush=True)


def uv_build(*arguments: str | Path) -> None:
    """Build a distribution."""
    done = subprocess.run([sys.executable, "-m", "uv", "build", "--quiet", *arguments], capture_output=True, text=True)
    if done.returncode:
        raise ReleaseError(f"uv could not build the packages:\n{done.stderr.strip()}")


def build_repository(folder: Path, platforms: Sequence[str]) -> None:
    """Build the extension's zips, one for each Python and system, and the index that Blender reads."""
    command = [sys.executable, ROOT / "scripts" / "build_extension", "--split-platforms", "--repository"]
    chosen = [f"--platform={platform}" for platform in platforms]
    if subprocess.run([*command, f"--output={folder}", *chosen]).returncode:
        raise ReleaseError("not all zips could be built")


def write_checksums(folder: Path) -> None:
    """Write the digests of all files, as `sha256sum --check` reads them."""
    lines = []
    for path in sorted(folder.iterdir()):
        with path.open("rb") as file:
            lines.append(f"{hashlib.file_digest(file, 'sha256').hexdigest()}  {path.name}\n")
    (folder / CHECKSUMS).write_text("".join(lines), encoding="ascii", newline="\n")


def index_url(folder: Path) -> str:
    """Return the address of the repository, as Blender asks for it."""
    return (folder.resolve() / "index.json").as_uri()


if __name__ == "__main__":
    sys.exit(main())
