# SPDX-License-Identifier: GPL-3.0-or-later
"""Make a page for a browser of docs/walkthrough.md, with its pictures beside it: the extension brings it along."""

import re
import shutil
from pathlib import Path

from markdown_it import MarkdownIt

ROOT = Path(__file__).resolve().parent.parent
SOURCE = ROOT / "docs" / "walkthrough.md"
PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>A demolition by mouse</title>
<style>body {{ font: 16px/1.5 sans-serif; max-width: 50em; margin: 2em auto; padding: 0 1em }}
img {{ max-width: 100% }}</style></head>
<body>
{body}
</body></html>
"""


def write_page(folder: Path) -> Path:
    """Write the page and its pictures into a folder, which is made, and return the page."""
    text = SOURCE.read_text(encoding="utf-8")
    pictures = re.findall(r"!\[[^]]*\]\(([^)]+)\)", text)
    for picture in pictures:
        (folder / picture).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(SOURCE.parent / picture, folder / picture)
    # Links to other documents lead nowhere without them: their words stay.
    text = re.sub(r"(?<!!)\[([^]]*)\]\((?!http)[^)]*\)", r"\1", text)
    page = folder / "walkthrough.html"
    body = MarkdownIt().enable("table").render(text)
    page.write_text(PAGE.format(body=body), encoding="utf-8", newline="\n")
    return page
