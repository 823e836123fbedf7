# SPDX-License-Identifier: GPL-3.0-or-later
"""Every link in the documents leads somewhere, and every file and name of code in them is there."""

import re
from collections import Counter

import pytest
from support.checkout import ROOT

PACKAGE = ROOT / "bridge_demolition_addon"
BESIDE_THE_CODE = [
    page
    for folder in (PACKAGE, *(ROOT / name for name in ("core", "examples", "scripts", "tests", "validation")))
    for page in sorted(folder.rglob("README.md"))
]
DOCUMENTS = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").glob("*.md")), *BESIDE_THE_CODE]
MADE = {line.strip("/") for line in (ROOT / ".gitignore").read_text(encoding="utf-8").split()}
"""What a run or a build leaves in the project."""

FOLDERS = "|".join(
    path.name
    for base in (ROOT, PACKAGE)
    for path in base.iterdir()
    if path.is_dir() and path.name[0] != "." and path.name not in MADE
)


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


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_every_link_leads_to_a_file_and_its_heading(document):
    assert broken_links(document) == []


def test_a_link_that_leads_nowhere_is_found(tmp_path):
    (tmp_path / "other.md").write_text("# One: two\n\n## [[a.b_c]]\n\n## One two\n\n```\n# no heading\n```\n")
    good = "[a](other.md) [b](other.md#one-two-1) ![c](#here) [`d`](other.md#ab_c) [e](https://example.org/none)"
    bad = '[f](none.md) [g](other.md#no-heading) <img src="none.png"> [h](../outside.md)'
    document = tmp_path / "document.md"
    document.write_text(f"# Here\n\n{good}\n\n{bad}\n")
    assert sorted(broken_links(document, tmp_path)) == ["../outside.md", "none.md", "none.png", "other.md#no-heading"]


def named_paths(text):
    """Paths of the project in a text, wherever they stand: `engineering/units.py`, `scripts/test`."""
    found = re.findall(rf"(?<![\w./])(?:{FOLDERS})/[\w./*]*[\w*]", text)
    return [path for path in found if "NAME" not in path]


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_every_path_in_the_text_is_there(document):
    paths = set(named_paths(document.read_text(encoding="utf-8")))
    assert [path for path in paths if not any([*ROOT.glob(path), *PACKAGE.glob(path)])] == []


def test_paths_are_found_in_a_text():
    text = (
        "`engineering/units.py` [a](../model/b.py) runs/model/c, `scripts/test tests/model -k x`, examples/i235_*.toml."
    )
    assert named_paths(text) == ["engineering/units.py", "scripts/test", "tests/model", "examples/i235_*.toml"]


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_every_dotted_name_of_code_is_there(document):
    layers = "|".join(path.parent.name for path in PACKAGE.glob("*/__init__.py"))
    named = re.findall(rf"`((?:{layers})\.[\w.]+)\.(\w+)`", document.read_text(encoding="utf-8"))
    assert [
        names for names in named if not defines(PACKAGE.joinpath(*names[0].split(".")).with_suffix(".py"), names[1])
    ] == []


def defines(module, name):
    """Whether a module defines a function, a class or a value of a name at any depth."""
    return re.search(rf"^ *(?:(?:def|class) {name}\b|{name}(?: =|:))", module.read_text(encoding="utf-8"), flags=re.M)


def test_every_row_of_the_architecture_names_what_its_files_define():
    layout = (PACKAGE / "README.md").read_text(encoding="utf-8").partition("## Code: Appendix A")[0]
    rows = [line for line in layout.splitlines() if ".py)" in line]
    assert len(rows) > 4
    for row in rows:
        modules = [PACKAGE / path for path in re.findall(r"\]\(([^)]+\.py)\)", row)]
        for name in re.findall(r"`(\w+)`", row):
            assert any(defines(module, name) for module in modules), f"{name}: {row}"


def test_documents_can_be_read():
    """Words of the site's own pages and the README, without the bars of tables: 90 000 are what was asked for."""
    pages = [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]
    assert sum(len(re.findall(r"[^\s|]*\w[^\s|]*", page.read_text(encoding="utf-8"))) for page in pages) <= 90_000
