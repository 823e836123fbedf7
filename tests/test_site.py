# SPDX-License-Identifier: GPL-3.0-or-later
"""The site of the documents builds without a warning, leads nowhere that is not there, and needs no network."""

import inspect
import json
import re
import subprocess
import sys
from html.parser import HTMLParser
from urllib.parse import unquote, urldefrag

import pytest
from site_build import MADE, versions_in
from site_files import SitePages
from support.checkout import ROOT

import bridge_demolition_addon as interface
from bridge_demolition_addon.cli.main import COMMANDS
from bridge_demolition_addon.version import VERSION

pytestmark = pytest.mark.long

PROGRAM = ROOT / "scripts" / "site_build.py"
DOCS = sorted((ROOT / "docs").glob("*.md"))
ELSEWHERE = re.compile(r"(?:[a-z]+:)?//", re.IGNORECASE)
LOADED = {("img", "src"), ("link", "href"), ("script", "src"), ("iframe", "src"), ("source", "src"), ("video", "src")}
"""Elements that a browser loads by itself, with the attribute that says from where."""


def call(*arguments):
    return subprocess.run(
        [sys.executable, str(PROGRAM), *map(str, arguments)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )


class PageReader(HTMLParser):
    """Ids of a page, where it leads to, and what a browser loads for it."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.leads_to, self.loads, self.has_source = set(), [], [], False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.ids |= {values[name] for name in ("id", "name") if values.get(name)}
        self.loads += [value for name, value in attributes if (tag, name) in LOADED]
        self.leads_to += [value for name, value in attributes if name in ("href", "src") and value]
        self.has_source |= (
            values.get("data-md-component") == "source" or "mermaid" in (values.get("class") or "").split()
        )


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The folder of the site, which is made once."""
    folder = tmp_path_factory.mktemp("made") / "site"
    done = call(folder)
    assert (done.returncode, done.stderr) == (0, "")
    return folder


@pytest.fixture(scope="module")
def pages(site):
    """What each page says, by its path."""
    return {path: PageReader(path.read_text(encoding="utf-8")) for path in sorted(site.rglob("*.html"))}


def broken_links(pages):
    """Links of pages that lead to no file, or to no heading of a page; those to other sites are not followed."""
    for path, page in pages.items():
        for link in dict.fromkeys(page.leads_to):
            if ELSEWHERE.match(link) or link.startswith(("data:", "mailto:")):
                continue
            target, anchor = urldefrag(link)
            found = (path.parent / unquote(target)).resolve() if target else path
            if found.is_dir() and found != path.parent:
                found /= "index.html"
            is_there = found.is_file() or (found.is_dir() and target in (".", "./"))
            # Those with two underscores are of the theme, which makes some as the page is shown.
            has_heading = not anchor or anchor.startswith("__") or found not in pages or anchor in pages[found].ids
            if not is_there or not has_heading:
                yield f"{path.name}: {link}"


def test_no_link_leads_nowhere(pages):
    ours = {
        path: page for path, page in pages.items() if path.name != "404.html"
    }  # whose links begin at a server's root
    assert len(ours) > len(DOCS)
    assert [*broken_links(ours)] == []


def test_a_link_that_leads_nowhere_is_found(tmp_path):
    (tmp_path / "other.html").write_text('<h2 id="here">Here</h2>', encoding="utf-8")
    links = ("other.html", "other.html#here", "https://example.org", "none.html", "other.html#none", "#none")
    (tmp_path / "page.html").write_text("".join(f'<a href="{link}">' for link in links), encoding="utf-8")
    read = {path: PageReader(path.read_text(encoding="utf-8")) for path in tmp_path.iterdir()}
    assert [*broken_links(read)] == ["page.html: none.html", "page.html: other.html#none", "page.html: #none"]


def test_nothing_is_loaded_from_a_network(site, pages):
    loaded = {link for page in pages.values() for link in page.loads if link}
    assert loaded and [link for link in loaded if ELSEWHERE.match(link)] == []
    # The theme would load what draws diagrams, and ask a repository for its stars.
    assert not any(page.has_source for page in pages.values())
    for sheet in site.rglob("*.css"):
        text = sheet.read_text(encoding="utf-8")
        assert not re.search(r"(?:url\(|@import)\s*[\"']?(?:https?:)?//", text), sheet


def test_every_page_of_the_documents_is_in_the_navigation(site):
    shown = PageReader((site / "index.html").read_text(encoding="utf-8"))
    assert {f"{path.stem}.html" for path in DOCS} <= {link.removeprefix("./") for link in shown.leads_to}


def test_every_page_shows_the_version(pages):
    assert all(f"Version {VERSION}" in path.read_text(encoding="utf-8") for path in pages)


def test_the_search_finds_every_page_of_the_documents_and_none_of_the_code(site):
    index = json.loads((site / "search" / "search_index.json").read_text(encoding="utf-8"))["docs"]
    found = {urldefrag(entry["location"])[0] for entry in index}
    assert {f"{path.stem}.html" for path in DOCS} <= found
    assert [place for place in found if place.startswith("project/")] == []
    # What is read without a server, as files.
    assert (site / "search" / "search_index.js").read_text(encoding="utf-8").startswith("var __index")


def test_every_function_is_in_the_reference_with_its_arguments(site):
    page = PageReader((site / "python_reference.html").read_text(encoding="utf-8"))
    functions = [name for name in interface.__all__ if inspect.isfunction(getattr(interface, name))]
    assert {f"bridge_demolition_addon.{name}" for name in functions} <= page.ids


def test_the_page_of_the_commands_has_their_options(site):
    text = (site / "commands.html").read_text(encoding="utf-8")
    assert {f"bda-{name}" for name in COMMANDS} <= PageReader(text).ids
    assert "--no-pictures" in text and "--verify" in text


def test_a_folder_with_other_files_is_left_alone(tmp_path):
    kept = tmp_path / "letter.txt"
    kept.touch()
    done = call(tmp_path)
    assert (done.returncode, kept.is_file()) == (2, True)
    assert done.stderr == (
        f"site: {tmp_path} holds other files: expected an empty or new folder, or that of a site, which is replaced\n"
    )


@pytest.fixture
def project(tmp_path):
    """A project with a document that leads out of the documents."""
    for name, text in {
        "README.md": "[a document](docs/a.md#b) ![a picture](docs/pictures/c.png)",
        "docs/a.md": "[it](../README.md#top) [code](../tool/code.py) [all](../tool) [here](b.md) `x` [net](https://e.org)",
        "docs/b.md": "# B",
        "docs/pictures/c.png": "",
        "tool/code.py": 'FENCE = "```"\n',
        "tool/deep/more.py": "",
    }.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path


def test_what_documents_lead_to_becomes_a_page(project):
    made = SitePages(project).made()
    assert [*made] == ["overview.md", "project/tool/index.md", "project/tool/code.py.md"]
    assert made["overview.md"] == "[a document](a.md#b) ![a picture](pictures/c.png)"
    assert made["project/tool/code.py.md"].endswith('# tool/code.py\n\n`````` python\nFENCE = "```"\n\n``````\n')
    assert made["project/tool/index.md"].endswith("# tool\n\n- [`code.py`](code.py.md)\n- `deep/`\n")


def test_links_of_a_document_lead_to_these_pages(project):
    document = project / "docs" / "a.md"
    assert SitePages(project).led(document.read_text(encoding="utf-8"), document) == (
        "[it](overview.md#top) [code](project/tool/code.py.md) [all](project/tool/index.md) [here](b.md) `x` [net](https://e.org)"
    )


def test_sites_of_several_versions_stand_beside_each_other(tmp_path, site, pages):
    """A site made before stays, the newest comes first, and each page leads to the list, however deep it lies."""
    earlier = tmp_path / "0.0.9" / "search"
    earlier.mkdir(parents=True)
    (earlier / "search_index.json").write_text("{}", encoding="utf-8")
    (tmp_path / "notes").mkdir()
    done = call("--among", tmp_path)
    assert done.returncode == 0, done.stderr
    found = PageReader((tmp_path / "index.html").read_text(encoding="utf-8"))
    assert found.leads_to == [f"{VERSION}/index.html", "0.0.9/index.html"]
    made = sorted((tmp_path / VERSION).rglob("*.html"))
    assert len(made) == len(pages)
    depths = set()
    for path in made:
        led_to = PageReader(path.read_text(encoding="utf-8")).leads_to
        back = [link for link in led_to if link.endswith("../index.html")]
        if path.name != "404.html":  # its links are those of a server
            assert tmp_path / "index.html" in [(path.parent / link).resolve() for link in back]
            depths.add(len(path.relative_to(tmp_path).parts))
    assert len(depths) > 1
    assert not any("All versions" in path.read_text(encoding="utf-8") for path in site.rglob("*.html"))


def test_versions_are_sorted_by_their_numbers(tmp_path):
    for name in ("0.9.0", "0.10.0", "1.0.0"):
        (tmp_path / name / "search").mkdir(parents=True)
        (tmp_path / name / MADE).touch()
    assert versions_in(tmp_path) == ["1.0.0", "0.10.0", "0.9.0"]
