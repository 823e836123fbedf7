# SPDX-License-Identifier: GPL-3.0-or-later
"""What a result depends on beside its inputs: runs of another code or of another core are not taken for the same."""

from importlib import reload

from bridge_demolition_addon.engineering.core import library
from bridge_demolition_addon.studies import versions


def test_a_core_of_other_sources_is_another_version(monkeypatch):
    here = reload(versions).versions_with("5.0")
    assert len(library.core_sources()) >= 12  # a digest of its files
    with monkeypatch.context() as patched:
        patched.setattr(library, "core_sources", lambda: "other sources")
        other = reload(versions).versions_with("5.0")
    assert {name for name in here if here[name] != other[name]} == {"bridge_demolition_addon"}
    assert reload(versions).versions_with("5.0") == here
