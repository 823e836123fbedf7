# SPDX-License-Identifier: GPL-3.0-or-later
"""A report in Chinese, on a machine with a font for it and on one without."""

import pytest
from fontTools.ttLib import TTFont
from matplotlib import font_manager
from support.stage_folders import with_stages

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.report.languages import letters
from bridge_demolition_addon.report.languages.translation import language_table
from bridge_demolition_addon.report.write import write_report

NAME = "Letters of Tests"


@pytest.fixture
def font(tmp_path, monkeypatch):
    """A font that shows a box for each Chinese letter of the table, as if the machine had it."""
    file = TTFont(font_manager.findfont("DejaVu Sans"))
    used = {ord(letter) for text in language_table("zh_hans").texts.values() for letter in text if ord(letter) > 0x2E80}
    for table in file["cmap"].tables:
        if table.isUnicode():
            table.cmap |= dict.fromkeys(used, "H")
    for record in file["name"].names:
        if record.nameID in (1, 4, 6, 16):
            name = NAME.replace(" ", "") if record.nameID == 6 else NAME
            file["name"].setName(name, record.nameID, record.platformID, record.platEncID, record.langID)
    path = tmp_path / "letters.ttf"
    file.save(path)
    known = list(font_manager.fontManager.ttflist)
    font_manager.fontManager.addfont(path)
    monkeypatch.setattr(letters, "CHINESE_FONTS", (NAME,))
    yield
    font_manager.fontManager.ttflist = known


def test_with_a_font_page_and_pdf_are_chinese(font, tmp_path):
    folder = with_stages(tmp_path / "stages")
    written = write_report([folder], None, language="zh_hans", progress=Silence())
    assert [path.name for path in written[:2]] == ["report.html", "report.pdf"]
    html = written[0].read_text(encoding="utf-8")
    assert '<html lang="zh-Hans">' in html and "极限荷载系数" in html
    assert b"LettersofTests" in written[1].read_bytes()


def test_without_a_font_the_page_is_chinese_and_the_error_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setattr(letters, "CHINESE_FONTS", ())
    folder = with_stages(tmp_path / "stages")
    for name in ("report.html", "report.pdf"):
        (folder / name).write_bytes(b"of an earlier report")
    with pytest.raises(OutputError, match=r"apt install fonts-noto-cjk"):
        write_report([folder], None, language="zh_hans", progress=Silence())
    assert "极限荷载系数" in (folder / "report.html").read_text(encoding="utf-8")
    assert not (folder / "report.pdf").exists() and (folder / "tables" / "stages.csv").is_file()
