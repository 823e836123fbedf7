"""Every link in the documents leads somewhere."""

import re
from collections import Counter

import pytest
from places import ROOT

DOCUMENTS = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


def targets(text):
    """Where links and pictures lead, in Markdown and in HTML."""
    return re.findall(r"\]\(\s*<?([^)\s>]+)", text) + re.findall(r"""(?:href|src)=["']([^"']+)""", text)


def anchors(text):
    """Anchors that GitHub gives to headings: lower case, without punctuation, numbered where they are the same."""
    seen, found = Counter(), set()
    for heading in re.findall(r"^#{1,6} +(.+?) *#*$", re.sub(r"^```.*?^```", "", text, flags=re.S | re.M), flags=re.M):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        anchor = re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-")
        found.add(f"{anchor}-{seen[anchor]}" if seen[anchor] else anchor)
        seen[anchor] += 1
    return found


def broken_links(document, root=ROOT):
    """Links of a document that lead to no file, or to no heading of it; those to other sites are not followed."""
    broken = []
    for target in targets(document.read_text(encoding="utf-8")):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        found = document.parent / path if path else document
        is_there = found.exists() and found.resolve().is_relative_to(root)
        if not is_there or (anchor and anchor not in anchors(found.read_text(encoding="utf-8"))):
            broken.append(target)
    return broken


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_every_link_leads_to_a_file_and_its_heading(document):
    assert broken_links(document) == []


def test_a_link_that_leads_nowhere_is_found(tmp_path):
    (tmp_path / "other.md").write_text("# One: two\n\n## [[a.b_c]]\n\n## One two\n\n```\n# no heading\n```\n")
    good = "[a](other.md) [b](other.md#one-two-1) ![c](#here) [`d`](other.md#ab_c) [e](https://example.org/none)"
    bad = '[f](none.md) [g](other.md#no-heading) <img src="none.png"> [h](../outside.md)'
    document = tmp_path / "document.md"
    document.write_text(f"# Here\n\n{good}\n\n{bad}\n")
    assert sorted(broken_links(document, tmp_path)) == ["../outside.md", "none.md", "none.png", "other.md#no-heading"]
