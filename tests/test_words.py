# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages, docstrings, comments, messages and labels use the words of docs/glossary.md, and none of docs/words.toml."""

import ast
import io
import re
import tokenize
import tomllib
from functools import cache

from support.checkout import ROOT

PACKAGE = ROOT / "bridge_demolition_addon"
PAGES = [
    *(ROOT / f"{name}.md" for name in ("README", "CHANGELOG", "CONTRIBUTING")),
    *sorted((ROOT / "docs").glob("*.md")),
    *(
        page
        for name in ("core", "examples", "scripts", "tests", "validation")
        for page in sorted((ROOT / name).rglob("README.md"))
    ),
    *sorted(PACKAGE.rglob("README.md")),
]
EXAMPLES = sorted((ROOT / "examples").rglob("*.toml"))
MODULES = sorted(PACKAGE.rglob("*.py"))
LISTS_WORDS = {"glossary.md"}
"""The page whose last column names what is not used."""


@cache
def refused():
    """Words that are not used: pattern, what stands instead, and texts in which it means something else."""
    table = tomllib.loads((ROOT / "docs" / "words.toml").read_text(encoding="utf-8"))
    return [
        (re.compile(row["pattern"], re.IGNORECASE), row["instead"], [text.lower() for text in row.get("except", [])])
        for row in table["words"]
    ]


def without_code(text):
    """Leave out what is code: blocks, spans in backticks, targets of links, names of keys."""
    text = re.sub(r"^```.*?^```|^(?: {4}|\t).*?$|<!--.*?-->", "", text, flags=re.S | re.M)
    text = re.sub(r"`[^`]*`", "`", text)
    return re.sub(r"\]\([^)]*\)|\b\w+(?:[_.]\w+)+\b|\b\w+/\w[\w/]*", "", text)


def text_of_page(path):
    return without_code(path.read_text(encoding="utf-8"))


def text_of_module(path):
    """Docstrings, comments, and strings of several words, a paragraph each."""
    source = path.read_text(encoding="utf-8")
    strings = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.JoinedStr):
            strings.append("".join(part.value if isinstance(part, ast.Constant) else "`" for part in node.values))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value:
            strings.append(node.value)
    return "\n".join(
        re.sub(r"`[^`]*`|\b\w+(?:[_.]\w+)+\b|\{[^}]*\}", "`", text) for text in [*strings, *comments_of(source)]
    )


def comments_of(source):
    """Comments of a module; most modules have no sign of one, and are not taken apart for it."""
    if "#" not in source:
        return []
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    return [token.string.lstrip("# ") for token in tokens if token.type == tokenize.COMMENT]


def text_of_example(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    return without_code("\n".join(line.partition("#")[2] for line in lines))


def wrong_words(text):
    """Refused words of a text, with what stands instead and what is around them."""
    text = re.sub(r"\s+", " ", text)
    for pattern, instead, meant_otherwise in refused():
        for match in pattern.finditer(text):
            around = text[max(0, match.start() - 30) : match.end() + 30]
            if not any(other in around.lower() for other in meant_otherwise):
                yield f"{match.group()!r} in {around!r}: use {instead}"


def files():
    readers = {text_of_page: PAGES, text_of_module: MODULES, text_of_example: EXAMPLES}
    return [(path, reader) for reader, paths in readers.items() for path in paths if path.name not in LISTS_WORDS]


def test_no_refused_word_is_used():
    found = {path.relative_to(ROOT).as_posix(): list(wrong_words(text_of(path))) for path, text_of in files()}
    assert len(found) > 500
    assert {path: words for path, words in found.items() if words} == {}


def test_refused_words_are_found_in_text_and_not_in_code():
    assert [wrong.split(" in ")[0] for wrong in wrong_words("One draw bears it. Draw a line.")] == [
        "'One draw'",
        "'bears'",
    ]
    assert list(wrong_words(without_code("`spin` of rest_angular_velocity_rad_s, [draws](trials.md)"))) == []


def test_terms_of_the_glossary_are_in_order_and_no_other_term_refuses_them():
    sections = (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8").split("\n## ")[1:]
    for section in sections:
        terms = re.findall(r"^\| ([^|]+?) \|", section, flags=re.M)[2:]
        assert terms == sorted(terms, key=str.lower), section.splitlines()[0]
        assert [wrong for term in terms for wrong in wrong_words(term)] == []
