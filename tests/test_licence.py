# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests, scripts and validation begin with the licence line; that of the package's root is for all its modules."""

from support.checkout import ROOT

LINE = "# SPDX-License-Identifier: GPL-3.0-or-later"


def programs():
    """Modules of Python outside of the package and its root, and scripts without an ending."""
    yield ROOT / "bridge_demolition_addon" / "__init__.py"
    yield from (path for folder in ("tests", "validation") for path in (ROOT / folder).rglob("*.py"))
    yield from (path for path in (ROOT / "scripts").rglob("*") if path.suffix in ("", ".py") and path.is_file())


def test_every_program_begins_with_the_licence_line():
    without = []
    for path in programs():
        first, second, *_ = [*path.read_text(encoding="utf-8").split("\n", 2), ""]
        if LINE not in (first, second if first.startswith("#!") else first):
            without.append(path.relative_to(ROOT).as_posix())
    assert without == []
