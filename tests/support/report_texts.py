# SPDX-License-Identifier: GPL-3.0-or-later
"""What reports say, without writing them."""

from bridge_demolition_addon.report.comparison import comparison
from bridge_demolition_addon.report.document.blocks import DataTable, Paragraph
from bridge_demolition_addon.report.document.drawings import drawings
from bridge_demolition_addon.report.ensemble.study import study_document
from bridge_demolition_addon.report.run import run_document
from bridge_demolition_addon.report.run_folder import read_run
from bridge_demolition_addon.report.sections.debris import zone_of


class Told:
    """What a document says."""

    def __init__(self, document):
        self.titles = [section.title for section in document.sections]
        paragraphs = [block for block in document.blocks() if isinstance(block, Paragraph)]
        self.paragraphs = [block.text for block in paragraphs]
        self.notices = [block.text for block in paragraphs if block.is_notice]
        of_first = document.sections[0].blocks if document.sections else ()
        self.statement = next((block.text for block in of_first if isinstance(block, Paragraph)), "")
        self.tables = {block.name: block for block in document.blocks() if isinstance(block, DataTable)}

    def column(self, table, key):
        """The cells of a column of a table, as they stand in its file."""
        keys = [column.key for column in self.tables[table].columns]
        return [row[keys.index(key)] for row in self.tables[table].rows]


def told(folder):
    """What the report of a run says; all its pictures are drawn and laid out."""
    run = read_run(folder)
    document = run_document(run, "0", zone_of(run))
    assert drawings(document)
    return Told(document)


def told_of_study(runs):
    """What the report of a study says; all its pictures are drawn and laid out."""
    document = study_document(runs, "0")
    assert drawings(document)
    return Told(document)


def compared(*folders):
    """What the report of several runs says."""
    return Told(comparison([read_run(folder) for folder in folders], "0"))
