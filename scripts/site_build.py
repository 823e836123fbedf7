# SPDX-License-Identifier: GPL-3.0-or-later
"""Make a site of the documents, with search, to open in a browser without a network::

    python scripts/site_build.py [OUTPUT]          (build/site)
    python scripts/site_build.py --among FOLDER    this version in a folder of its own, and a page that leads to all

Needs an environment with the extra ``[site]``; on Linux, scripts/site makes one. mkdocs.yml has its sections.
"""

import argparse
import logging
import os
import re
import sys
from importlib.util import find_spec
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from bridge_demolition_addon.version import VERSION

ROOT = Path(__file__).resolve().parents[1]
MADE = Path("search", "search_index.json")
"""What tells a site from another folder: all in it is replaced."""

ALL_VERSIONS = """\
<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Bridge Demolition Add-on, all versions</title>
<style>body {{ font: 1.1rem/1.6 sans-serif; margin: 3rem auto; max-width: 40rem; padding: 0 1rem }}</style>
<h1>Bridge Demolition Add-on</h1>
<p>Documents of each version, the newest first.</p>
<ul>
{}
</ul>
"""
"""Page that leads to the sites of all versions."""


def fault_of(output: Path) -> str | None:
    """Return why a folder cannot take a site, or None."""
    if output.exists() and not output.is_dir():
        return f"{output} is a file: expected a folder"
    if output.is_dir() and any(output.iterdir()) and not (output / MADE).is_file():
        return f"{output} holds other files: expected an empty or new folder, or that of a site, which is replaced"
    return None


def versions_in(folder: Path) -> list[str]:
    """Return the versions whose sites are in a folder, the newest first."""
    sites = [path.name for path in folder.iterdir() if (path / MADE).is_file()]
    return sorted(sites, key=lambda name: [int(part) for part in re.findall(r"\d+", name)], reverse=True)


def write_all_versions(folder: Path) -> None:
    """Write the page that leads to the sites in a folder."""
    lines = (f'<li><a href="{name}/index.html">{name}</a></li>' for name in versions_in(folder))
    (folder / "index.html").write_text(ALL_VERSIONS.format("\n".join(lines)), encoding="utf-8")


def build(output: Path, *, among_others: bool = False) -> None:
    """Write the site, in place of what is there; a link that leads nowhere ends the program, with its page.

    Among others, each page leads to that of all versions, beside the folder.
    """
    os.environ["NO_MKDOCS_2_WARNING"] = "1"  # of a version that is not used
    from mkdocs.commands.build import build as build_site
    from mkdocs.config import load_config

    logging.basicConfig(format="site: %(message)s", level=logging.WARNING)
    settings = load_config(str(ROOT / "mkdocs.yml"), site_dir=str(output), strict=True)
    settings.extra["among_others"] = among_others
    settings.plugins.on_startup(command="build", dirty=False)
    build_site(settings)
    settings.plugins.on_shutdown()


def main() -> int:
    parser = argparse.ArgumentParser(description="Make a site of the documents.")
    parser.add_argument("output", nargs="?", type=Path, default=ROOT / "build" / "site", metavar="OUTPUT")
    parser.add_argument("--among", type=Path, metavar="FOLDER", help="make it in FOLDER/VERSION, beside other versions")
    options = parser.parse_args()
    output = (options.among / VERSION if options.among else options.output).resolve()
    if fault := fault_of(output):
        print(f"site: {fault}", file=sys.stderr)
        return 2
    if find_spec("mkdocs") is None:
        print('site: mkdocs is missing: install it by python -m pip install ".[site]"', file=sys.stderr)
        return 2
    from click.exceptions import ClickException

    try:
        build(output, among_others=bool(options.among))
    except ClickException as error:  # also where the settings are wrong
        print(f"site: {error.format_message()}", file=sys.stderr)
        return 1
    if options.among:
        write_all_versions(output.parent)
    print(f"Open {(output.parent if options.among else output) / 'index.html'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
