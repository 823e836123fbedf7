# SPDX-License-Identifier: GPL-3.0-or-later
"""The gallery shows every example, with what its source says now; examples themselves begin with five lines."""

import re

import gallery
import pytest

PARTS = ("To see:", "Assumed:", "To trust:")
OF_2019 = gallery.examples(gallery.REPORT_2019)
EXAMPLES = [*gallery.examples(), *OF_2019]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_example_tells_what_there_is_to_see_what_is_assumed_and_how_far_to_trust_it(path):
    told = gallery.paragraphs(path)
    assert [part for part in PARTS if any(heading.startswith(part) for heading in told)] == list(PARTS)


def test_those_of_2019_say_that_a_demolition_of_today_is_planned_with_others():
    assert "A demolition of today is planned with bars" in " ".join(gallery.HEADER_2019.split())
    assert [path.stem for path in OF_2019 if "2019 report" not in gallery.paragraphs(path)[0]] == []


def test_heads_of_examples_have_five_lines():
    for path in gallery.EXAMPLES.rglob("*.toml"):
        lines = path.read_text(encoding="utf-8").splitlines()
        head = next((number for number, line in enumerate(lines) if not line.startswith("#")), len(lines))
        assert head <= 5, path


def test_texts_are_of_examples_that_are_there():
    assert [file for file in gallery.texts() if not (gallery.EXAMPLES / file).is_file()] == []


def test_the_page_is_made_of_what_the_examples_say():
    assert gallery.PAGE.read_text(encoding="utf-8") == gallery.page()


def test_its_table_lists_all_examples():
    listed = re.findall(r"^\| \[(\w+)\]", gallery.page(), flags=re.M)
    assert listed == [gallery.name(path) for path in EXAMPLES]


def test_every_example_has_its_picture_and_its_time_and_no_other_has():
    names = {gallery.name(path) for path in EXAMPLES}
    assert {path.stem for path in gallery.PICTURES.glob("*.jpg")} == names
    assert set(gallery.times()) == names
    assert sum(gallery.times().values()) < 20 * 60
