# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages of the site for files of the project outside of the documents, and links that lead to them.

A document says ``../examples/two_spans_13m_ball.toml``, so that its links work where it lies. The site has no files
beside the documents: each that a link leads to becomes a page with its text, and each folder one with its list.
"""

import json
import posixpath
import re
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LINK = re.compile(r"(?<=\]\()([^)\s#]+)(?=[#)\s])")
"""Where a link or picture of Markdown leads, without its anchor."""

OWN_PAGES = {
    "README.md": "overview.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
    "SECURITY.md": "security.md",
    "docs/results.ipynb": "notebook.md",
}
"""Pages that are in the navigation, by their files."""

OTHERS = "project"
"""Folder of the site for the pages of all other files."""

LANGUAGES = {".py": "python", ".toml": "toml", ".js": "javascript", ".json": "json", ".cff": "yaml"}
MOST_BYTES = 400_000
NOT_SEARCHED = "---\nsearch:\n  exclude: true\n---\n\n"


class SitePages:
    """Pages that the site has beside the documents of a project."""

    def __init__(self, root: Path):
        self._root = root
        self._docs = root / "docs"

    def made(self) -> dict[str, str]:
        """Return the Markdown of each page, by its path in the site."""
        return {self._path_of(source): self._text_of(source) for source in sorted(self._sources)}

    def led(self, text: str, source: Path) -> str:
        """Return the text of a page, from its file, with links that lead to pages of the site."""
        here = posixpath.dirname(self._path_of(source))

        def path(match: re.Match) -> str:
            target = self._target(match.group(), source)
            return match.group() if target is None else posixpath.relpath(self._path_of(target), here or ".")

        return LINK.sub(path, text)

    @cached_property
    def _sources(self) -> set[Path]:
        """Files and folders that links lead to from the documents, and from pages that these lead to."""
        found: set[Path] = {self._root / name for name in OWN_PAGES if (self._root / name).exists()}
        open_ = [*sorted(self._docs.glob("*.md")), *found]
        while open_:
            for target in self._linked_from(open_.pop()):
                if target not in found and not self._is_copied(target):
                    found.add(target)
                    open_.append(target)
        return found

    def _linked_from(self, source: Path) -> Iterator[Path]:
        if source.is_dir():
            yield from (path for path in self._listed(source) if path.is_file() and is_text(path))
        elif source.suffix == ".md":
            for link in LINK.findall(source.read_text(encoding="utf-8")):
                if target := self._target(link, source):
                    yield target

    def _target(self, link: str, source: Path) -> Path | None:
        """Return the file or folder of the project that a link leads to, or None."""
        path = Path(posixpath.normpath((source.parent / link).as_posix()))
        return path if path.is_relative_to(self._root) and path.exists() else None

    def _is_copied(self, source: Path) -> bool:
        """Whether MkDocs itself has a page or a copy of it."""
        return source.is_relative_to(self._docs) and source.is_file() and self._name(source) not in OWN_PAGES

    def _path_of(self, source: Path) -> str:
        """Return the path in the site of a file or folder of the project."""
        name = self._name(source)
        if self._is_copied(source):
            return source.relative_to(self._docs).as_posix()
        return OWN_PAGES.get(name) or f"{OTHERS}/{name}{'/index' if source.is_dir() else ''}.md"

    def _name(self, source: Path) -> str:
        return source.relative_to(self._root).as_posix()

    def _text_of(self, source: Path) -> str:
        if source.is_dir():
            return NOT_SEARCHED + self._list_of(source)
        text = source.read_text(encoding="utf-8")
        if source.suffix == ".md":
            return ("" if self._name(source) in OWN_PAGES else NOT_SEARCHED) + self.led(text, source)
        if source.suffix == ".ipynb":
            return self.led(text_of_notebook(text), source)
        fence = "`" * 6
        return (
            f"{NOT_SEARCHED}# {self._name(source)}\n\n{fence} {LANGUAGES.get(source.suffix, 'text')}\n{text}\n{fence}\n"
        )

    def _list_of(self, folder: Path) -> str:
        """Return the page of a folder, with links to what the site has of it."""
        here = posixpath.dirname(self._path_of(folder))
        lines = []
        for path in self._listed(folder):
            label = f"`{path.name}{'/' if path.is_dir() else ''}`"
            there = posixpath.relpath(self._path_of(path), here)
            has_page = path in self._sources or self._is_copied(path)
            lines.append(f"- [{label}]({there})" if has_page else f"- {label}")
        return f"# {self._name(folder)}\n\n" + "\n".join(lines) + "\n"

    def _listed(self, folder: Path) -> list[Path]:
        return sorted(path for path in folder.iterdir() if not path.name.startswith((".", "__pycache__")))


def is_text(path: Path) -> bool:
    """Whether a file is a text that is short enough for a page."""
    if path.stat().st_size > MOST_BYTES:
        return False
    try:
        path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return False
    return True


def text_of_notebook(text: str) -> str:
    """Return the cells of a notebook as Markdown."""
    parts = []
    for cell in json.loads(text)["cells"]:
        source = "".join(cell["source"])
        parts.append(source if cell["cell_type"] == "markdown" else f"```python\n{source}\n```")
    return "\n\n".join(parts) + "\n"
