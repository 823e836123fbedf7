# SPDX-License-Identifier: GPL-3.0-or-later
"""Sentences on several lines of the sidebar."""

from types import SimpleNamespace

import pytest

SENTENCE = "Debris stayed within 1.1 m of the bridge's plan in all of them."


class Lines:
    """A layout that remembers its labels: text and icon."""

    def __init__(self):
        self.labels = []

    def column(self, **_settings):
        return self

    def label(self, *, text, icon, translate):
        assert not translate  # the whole sentence was looked up before
        self.labels.append((text, icon))


@pytest.mark.parametrize("icon, below", [("NONE", "NONE"), ("ERROR", "BLANK1")])
def test_all_lines_of_a_sentence_begin_below_each_other(blender, icon, below):
    from bridge_demolition_addon.ui.sidebar import draw_sentence

    context = SimpleNamespace(
        region=SimpleNamespace(width=300), preferences=SimpleNamespace(system=SimpleNamespace(ui_scale=1.0))
    )
    layout = Lines()
    draw_sentence(layout, context, SENTENCE, icon=icon)
    texts, icons = zip(*layout.labels, strict=True)
    assert " ".join(texts) == SENTENCE and len(texts) > 1
    assert icons == (icon, *[below] * (len(texts) - 1))


@pytest.mark.parametrize(
    ("text", "letters", "lines"),
    [
        ("Next: Run, and watch it", 12, ["Next: Run,", "and watch it"]),
        ("运行并观察桥梁", 10, ["运行并观察", "桥梁"]),  # each letter is two Latin ones wide
        ("", 10, []),
    ],
)
def test_lines_are_as_wide_as_the_sidebar_in_any_script(text, letters, lines):
    from bridge_demolition_addon.ui.sidebar import width_of, wrap

    assert wrap(text, letters) == lines
    assert all(width_of(line) <= letters for line in lines)
