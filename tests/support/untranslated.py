# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts without a translation: a warning while one works, so that a label is one line; a release refuses them."""

import os
import warnings
from collections.abc import Sequence

OF_RELEASE = "BDA_RELEASE"
"""Environment variable that `scripts/release` sets for the tests of translations."""


def warn_of(texts: Sequence[object], language: str) -> None:
    """Warn of texts that a language lacks; in a release that fails."""
    if texts and not os.environ.get(OF_RELEASE):
        warnings.warn(f"{language} lacks {len(texts)} texts, the first is {texts[0]!s}", stacklevel=2)
    else:
        assert list(texts) == []
