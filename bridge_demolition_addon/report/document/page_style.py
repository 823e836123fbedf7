"""Where things stand on the pages of a PDF, and in which letters."""

from ...charts.style import PAGE_WIDTH_MM
from .page import PAGE_MM, Font

LEFT_MM = (PAGE_MM[0] - PAGE_WIDTH_MM) / 2.0
TOP_MM, BOTTOM_MM = 20.0, 277.0
FOOT_MM = 285.0
LINE = 1.4
"""Height of a line by the size of its letters."""

TITLE, HEADING = Font(18.0, "bold"), Font(13.0, "bold")
TEXT, STRONG = Font(9.5), Font(9.5, "bold")
SMALL, SMALL_STRONG = Font(8.0), Font(8.0, "bold")
LISTING = Font(7.0, family="monospace")

GAP_MM = 3.0
"""Between columns of a table."""
