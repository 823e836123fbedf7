# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels of the tab: opening and closing them by their headers, and making the sidebar wider."""

from person import NOTCHES, Person, Steps

PANELS = (
    *("Scenario", "Bridge", "Fracture", "Connections", "Shards", "Ball and Sequence"),
    *("Explosion", "Record", "Post Processing", "Results", "Report", "Stages", "Study", "Search"),
)
"""From the top of the tab to its bottom."""

FIRST_HEADER_PX, HEADER_PX, SUB_HEADER_PX = 14, 28, 26
"""From the top of the sidebar to the middle of the first header, and between two headers of closed panels."""
BELOW_CONTENT_PX = 32
"""From the last button of a panel to the middle of the header of its first sub-panel."""
EDGE_PX = 8
"""From the left of the sidebar's region to the edge that is seen."""


class Panels:
    """Shows one panel of the sidebar at a time.

    Parameters
    ----------
    person
        Whose sidebar has just been opened for the first time.
    """

    def __init__(self, person: Person):
        self._person = person
        self._shown: str | None = None

    def show_only(self, panel: str) -> Steps:
        """Open a panel and close all others: by Ctrl and a click on its header."""
        yield from self._person.scroll_to_top()
        if self._shown is None:  # the first one is open, and others
            yield from self._click(PANELS[0])
            yield from self._click(PANELS[0], ctrl=True)
            self._shown = PANELS[0]
        if PANELS.index(panel) > PANELS.index(self._shown):
            yield from self._click(self._shown)
        if panel != self._shown:
            yield from self._click(panel, ctrl=True)
        self._shown = panel
        self._person.looks_from = self._header(panel)  # its buttons are below it

    def toggle_inner(self, number: int, last: str) -> Steps:
        """Open or close a sub-panel of the shown panel, where those above it are closed.

        Parameters
        ----------
        number
            Of the sub-panel, from 0.
        last
            The last button or field above all sub-panels.
        """
        below = BELOW_CONTENT_PX + number * SUB_HEADER_PX
        self._person.looks_from = None
        yield from self._person.hover(last)
        if self._person.mouse[1] - below < self._person.sidebar.y + SUB_HEADER_PX:
            yield from self._person.scroll(NOTCHES)
            yield from self._person.hover(last)
        x, y = self._person.mouse
        yield from self._person.move(x, y - below)
        yield from self._person.press("LEFTMOUSE")
        yield 0.5

    def widen(self, pixels: int) -> Steps:
        """Drag the left edge of the sidebar outwards."""
        sidebar = self._person.sidebar
        x, y = sidebar.x + EDGE_PX, sidebar.y + sidebar.height // 3
        yield from self._person.drag((x, y), (x - pixels, y))
        yield 0.3

    def _click(self, panel: str, **modifiers: bool) -> Steps:
        sidebar = self._person.sidebar
        yield from self._person.move(sidebar.x + sidebar.width // 2, self._header(panel))
        yield from self._person.press("LEFTMOUSE", **modifiers)
        yield 0.6  # Blender moves the panels slowly

    def _header(self, panel: str) -> int:
        """Height of a header in the window, where all panels above it are closed."""
        sidebar = self._person.sidebar
        return sidebar.y + sidebar.height - FIRST_HEADER_PX - HEADER_PX * PANELS.index(panel)
