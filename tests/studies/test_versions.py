# SPDX-License-Identifier: GPL-3.0-or-later
"""What a result depends on beside its inputs: runs of another code or of another core are not taken for the same."""

import pytest

from bridge_demolition_addon.engineering.core import library
from bridge_demolition_addon.model.run_folder import own_code as module
from bridge_demolition_addon.studies.versions import versions_with


@pytest.fixture(autouse=True)
def known_anew():
    """The digest is worked out once in a process: the tests around these are to have that of the code that is here."""
    module.own_code.cache_clear()
    yield
    module.own_code.cache_clear()


def test_a_core_of_other_sources_is_another_version(monkeypatch):
    here = versions_with("5.0")
    assert len(library.core_sources()) >= 12  # a digest of its files
    module.own_code.cache_clear()
    with monkeypatch.context() as patched:
        patched.setattr(module, "core_sources", lambda: "other sources")
        other = versions_with("5.0")
    assert {name for name in here if here[name] != other[name]} == {"bridge_demolition_addon"}
    module.own_code.cache_clear()
    assert versions_with("5.0") == here
