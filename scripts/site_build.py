# SPDX-License-Identifier: GPL-3.0-or-later
"""Make a site of the documents, with search, to open in a browser without a network::

    python scripts/site_build.py [OUTPUT]      (build/site)

Needs an environment with the extra ``[site]``; on Linux, scripts/site makes one. mkdocs.yml has its sections.
"""

import argparse
import logging
import os
import sys
from importlib.util import find_spec
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MADE = Path("search", "search_index.json")
"""What tells a site from another folder: all in it is replaced."""


def fault_of(output: Path) -> str | None:
    """Return why a folder cannot take a site, or None."""
    if output.exists() and not output.is_dir():
        return f"{output} is a file: expected a folder"
    if output.is_dir() and any(output.iterdir()) and not (output / MADE).is_file():
        return f"{output} holds other files: expected an empty or new folder, or that of a site, which is replaced"
    return None


def build(output: Path) -> None:
    """Write the site, in place of what is there; a link that leads nowhere ends the program, with its page."""
    os.environ["NO_MKDOCS_2_WARNING"] = "1"  # of a version that is not used
    from mkdocs.commands.build import build as build_site
    from mkdocs.config import load_config

    logging.basicConfig(format="site: %(message)s", level=logging.WARNING)
    settings = load_config(str(ROOT / "mkdocs.yml"), site_dir=str(output), strict=True)
    settings.plugins.on_startup(command="build", dirty=False)
    build_site(settings)
    settings.plugins.on_shutdown()


def main() -> int:
    parser = argparse.ArgumentParser(description="Make a site of the documents.")
    parser.add_argument("output", nargs="?", type=Path, default=ROOT / "build" / "site", metavar="OUTPUT")
    output = parser.parse_args().output.resolve()
    if fault := fault_of(output):
        print(f"site: {fault}", file=sys.stderr)
        return 2
    if find_spec("mkdocs") is None:
        print('site: mkdocs is missing: install it by python -m pip install ".[site]"', file=sys.stderr)
        return 2
    from click.exceptions import ClickException

    try:
        build(output)
    except ClickException as error:  # also where the settings are wrong
        print(f"site: {error.format_message()}", file=sys.stderr)
        return 1
    print(f"Open {output / 'index.html'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
