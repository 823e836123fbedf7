# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels of the tab: opening and closing them by their headers, and making the sidebar wider."""

from collections.abc import Iterator
from itertools import pairwise

import bpy
from person import NOTCHES, Person, Steps
from traces import module

TAB = ""
"""What panels of the tab itself stand in."""

FIRST_HEADER_PX, HEADER_PX, SUB_HEADER_PX = 14, 28, 26
"""From the top of the sidebar to the middle of the first header, and between two headers of closed panels."""
BELOW_HEADER_PX = 26
"""From the header of a panel that draws nothing to that of the first panel in it."""
BELOW_CONTENT_PX = 32
"""From the last button of a panel to the middle of the header of its first sub-panel."""
EDGE_PX = 8
"""From the left of the sidebar's region to the edge that is seen."""
LEAST_BELOW_PX = 60
"""Of the sidebar, below a header that is to be clicked, as far as it can be scrolled."""


class Panels:
    """Shows one panel of the sidebar at a time.

    Parameters
    ----------
    person
        Whose sidebar has just been opened for the first time.
    """

    def __init__(self, person: Person):
        self._person = person
        self._open = {name for name, panel in found_panels() if "DEFAULT_CLOSED" not in panel.bl_options}

    def show_only(self, panel: str) -> Steps:
        """Open a panel, named by its label, and what it stands in; close what is open above it and beside it.

        What it stands in has to draw nothing itself, as the groups and their panels Advanced do: for others there is
        `toggle_inner`. One of the tab itself is opened by Ctrl and a click on its header, which closes the others.
        """
        way = way_to(panel)
        yield from self._person.scroll_to_top()
        yield from self._show_group(way[0])
        y = self._top_header(way[0])
        for outer, inner in pairwise(way):
            shown = self._shown_in(outer)
            y -= BELOW_HEADER_PX
            for above in shown[: shown.index(inner)]:
                if above in self._open:
                    yield from self._toggle(above, y)
                y -= SUB_HEADER_PX
            if inner not in self._open:
                yield from self._toggle(inner, y)
        yield from self._scroll_to(y)
        self._person.looks_from = self._in_window(y)  # its buttons are below it

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

    def _show_group(self, group: str) -> Steps:
        """Have one panel of the tab open, and no other."""
        others = [name for name in self._shown_in(TAB) if name != group and name in self._open]
        if group in self._open and not others:
            return
        first = self._shown_in(TAB)[0]
        if first in self._open:
            yield from self._toggle(first, self._top_header(first))
        yield from self._toggle(first, self._top_header(first), ctrl=True)  # now all others are closed
        if group != first:
            yield from self._toggle(first, self._top_header(first))
            yield from self._toggle(group, self._top_header(group))
        self._open = {name for name in self._open if name not in self._shown_in(TAB)} | {group}

    def _toggle(self, panel: str, y: int, **modifiers: bool) -> Steps:
        """Click a header, by its height in the whole of the tab."""
        yield from self._scroll_to(y)
        sidebar = self._person.sidebar
        yield from self._person.move(sidebar.x + sidebar.width // 2, self._in_window(y))
        yield from self._person.press("LEFTMOUSE", **modifiers)
        self._open ^= {panel}
        yield 0.6  # Blender moves the panels slowly

    def _scroll_to(self, y: int) -> Steps:
        """Scroll until a height is well above the lower edge of the sidebar, or nothing is below that."""
        for _ in range(NOTCHES):
            before = self._scrolled()
            if self._in_window(y) > self._person.sidebar.y + LEAST_BELOW_PX:
                return
            yield from self._person.scroll(2)
            yield 0.2
            if self._scrolled() == before:
                return

    def _in_window(self, y: int) -> int:
        """Where a height in the whole of the tab is in the window now: 0 is its top, all others are below it."""
        sidebar = self._person.sidebar
        return sidebar.y + sidebar.height + y + self._scrolled()

    def _scrolled(self) -> int:
        sidebar = self._person.sidebar
        return round(-sidebar.view2d.region_to_view(0, sidebar.height - 1)[1])

    def _top_header(self, panel: str) -> int:
        """Height of a header of the tab itself, where all panels above it are closed."""
        return -FIRST_HEADER_PX - HEADER_PX * self._shown_in(TAB).index(panel)

    def _shown_in(self, outer: str) -> list[str]:
        """The names of the panels in one, from top to bottom, of which there are some only at times."""
        with self._person.in_sidebar():
            inside = [(name, panel) for name, panel in found_panels() if getattr(panel, "bl_parent_id", "") == outer]
            return [name for name, panel in inside if not hasattr(panel, "poll") or panel.poll(bpy.context)]


def found_panels() -> Iterator[tuple[str, type]]:
    """All panels by name, those in one from top to bottom."""
    found = module("ui.registration").classes()
    return ((panel.__name__, panel) for panel in found if issubclass(panel, bpy.types.Panel))


def way_to(label: str) -> list[str]:
    """The names of the panels from one of the tab to one in it, which is named by its label.

    Of several with a label it is the outermost.
    """
    panels = dict(found_panels())
    way = [next(name for name, panel in panels.items() if panel.bl_label == label)]
    while outer := getattr(panels[way[0]], "bl_parent_id", TAB):
        way.insert(0, outer)
    return way
