# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of all commands, as the site has them below docs/commands.md."""

import os
from contextlib import redirect_stdout
from io import StringIO

from bridge_demolition_addon.cli.main import COMMANDS, main

COLUMNS = "100"


def options() -> str:
    """Return what ``bda COMMAND --help`` prints, as Markdown with a heading for each command."""
    os.environ["COLUMNS"] = COLUMNS  # whatever the width of the terminal
    return "\n## Options\n" + "".join(f"\n### bda {name}\n\n```text\n{_help_of(name)}```\n" for name in COMMANDS)


def _help_of(command: str) -> str:
    with redirect_stdout(StringIO()) as printed:
        main([command, "--help"])
    return printed.getvalue()
