# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases of a test of which some are always tried, and all others where tests that take long are."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest


def long_but(shortly: Iterable[Any], cases: Iterable[Any], *, several: bool = False) -> list[Any]:
    """Mark all cases as long but those that are always tried; `several` says that each has a value for each name."""
    always, cases = list(shortly), list(cases)
    missing = [case for case in always if case not in cases]
    assert not missing, f"no such cases: {missing}"
    return [
        case if case in always else pytest.param(*(case if several else [case]), marks=pytest.mark.long)
        for case in cases
    ]
