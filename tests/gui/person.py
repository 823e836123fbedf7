# SPDX-License-Identifier: GPL-3.0-or-later
"""Someone at Blender's window: a hand on mouse and keyboard, and an eye on the sidebar and the reports.

What takes time is a generator, to be called with ``yield from``: it hands over to Blender until its next step.
"""

import json
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy

Steps = Iterator[float | None]

TAB = "BDA"
TAB_PX = 20
"""Width of the tabs' edge, and less than a tab is high."""
SCROLLS, NOTCHES, TO_THE_END = 3, 8, 30
"""How often the sidebar is scrolled in search of something, and by how much of the wheel: less than its height."""
MARGIN_PX = 5
"""From the left of the sidebar to a place that is beside all buttons and lists."""

AT_THE_TOP_PX = 3

KEYS = {".": "PERIOD", ",": "COMMA", "-": "MINUS", " ": "SPACE", "/": "SLASH"} | dict(
    zip("0123456789", ("ZERO", "ONE", "TWO", "THREE", "FOUR", "FIVE", "SIX", "SEVEN", "EIGHT", "NINE"), strict=True)
)
"""Keys that are not called by their letter."""

MODIFIERS = {"shift": "LEFT_SHIFT", "ctrl": "LEFT_CTRL"}

STATUS_BAR_PX = 24
DRAG_STEPS = 8
FAST_LETTERS = 8
"""That Blender gets at once."""

PICTURES = "pictures"
"""Folder for the pictures of the walk-through, among what is kept of a job."""
PICTURE_COLOURS = 128
"""Few enough for a small file, and enough for contours."""

PROBE_PX = 10
"""Between two places where the mouse looks for a button: half of a button's height."""
FOOT_PX = 2 * PROBE_PX
"""At the foot of a region, where a button is cut off and the mouse would move the edge between two areas instead."""
PROBE_COLUMNS = (0.7, 0.3, 0.5, 0.9, 0.78)
"""Where across the sidebar the mouse looks for buttons."""


@dataclass(frozen=True, slots=True)
class Place:
    """A part of a window, with buttons in it."""

    window: bpy.types.Window
    area: bpy.types.Area
    region: bpy.types.Region


@dataclass(frozen=True, slots=True)
class Part:
    """A part of the window by its pixels, counted from the lower left corner."""

    x: int
    y: int
    width: int
    height: int


class Person:
    """Works in the windows of Blender, and notes in a folder what was found right and wrong.

    Parameters
    ----------
    folder
        Folder for the notes and screenshots.
    """

    def __init__(self, folder: Path):
        self.folder = folder
        self.mouse = (0, 0)
        self.clicks = 0
        self._hand: bpy.types.Window | None = None
        self._pictures = 0
        self.looks_from: int | None = None
        self._seen: dict[tuple[str, str], tuple[int, int]] = {}

    # What there is to see

    @property
    def window(self) -> bpy.types.Window:
        """Blender's window, which a loaded file may replace."""
        return bpy.context.window_manager.windows[0]

    @property
    def scene(self) -> bpy.types.Scene:
        """The scene in the window."""
        return self.window.scene

    @property
    def playing(self) -> bool:
        """Whether the timeline plays."""
        return self.window.screen.is_animation_playing

    @property
    def view(self) -> bpy.types.Area:
        """The 3D view."""
        return self._area("VIEW_3D")

    @property
    def sidebar(self) -> bpy.types.Region:
        """The sidebar of the 3D view."""
        return region_of(self.view, "UI")

    @property
    def status_bar(self) -> Part:
        """The line at the foot of the window, as far as the 3D view reaches."""
        return Part(self.view.x, 0, self.view.width, STATUS_BAR_PX)

    @property
    def hand(self) -> bpy.types.Window:
        """The window that mouse and keyboard are in."""
        return self._hand if self._hand in list(bpy.context.window_manager.windows) else self.window

    def take_to(self, window: bpy.types.Window | None) -> None:
        """Take mouse and keyboard to another window, or back to the first one for None."""
        self._hand = window

    def open_sidebar(self) -> Steps:
        """Show the tab, and the reports in place of the outliner.

        Raises
        ------
        LookupError
            There is no such tab.
        """
        next(area for area in self.window.screen.areas if area.type in ("OUTLINER", "INFO")).ui_type = "INFO"
        self.view.spaces.active.show_region_ui = True
        yield 0.5
        sidebar = self.sidebar
        for y in range(sidebar.y + sidebar.height - TAB_PX, sidebar.y, -TAB_PX):
            yield from self.move(sidebar.x + sidebar.width - TAB_PX // 2, y)
            yield from self.press("LEFTMOUSE")
            if sidebar.active_panel_category == TAB:
                return
        raise LookupError(f"the sidebar has no tab {TAB}")

    def take_reports(self) -> list[str]:
        """What was reported, of whatever level, since it was last taken; without the log of what was done."""
        area = self._area("INFO")
        bpy.context.window_manager.clipboard = ""
        with bpy.context.temp_override(window=self.window, area=area, region=region_of(area, "WINDOW")):
            bpy.ops.info.select_all(action="SELECT")
            bpy.ops.info.report_copy()
            bpy.ops.info.report_delete()
        lines = bpy.context.window_manager.clipboard.splitlines()
        reports = [line for line in lines if line and not line.startswith("bpy.")]
        with (self.folder / "reports.txt").open("a", encoding="utf-8") as file:
            file.writelines(f"{report}\n" for report in reports)
        return reports

    def refusal(self, operator: str) -> str:
        """Why a button is greyed: what its tooltip says. Empty where it is not."""
        group, name = operator.split(".")
        with self.in_sidebar():
            call = getattr(getattr(bpy.ops, group), name)
            if call.poll():
                return ""
            try:
                call()
            except RuntimeError as error:
                return str(error).partition("poll()")[2].strip()
        return ""

    # What the hand does

    def move(self, x: int, y: int) -> Steps:
        """Move the mouse to a place in the window, counted from its lower left corner."""
        self.mouse = (x, y)
        self.hand.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
        yield

    def move_to_view(self) -> Steps:
        """Move the mouse over the 3D view, where shortcuts are meant for it."""
        yield from self.move(self.view.x + 200, self.view.y + 100)

    def press(self, key: str, unicode: str | None = None, **modifiers: bool) -> Steps:
        """Press a key or button of the mouse where the mouse is, and let it go."""
        x, y = self.mouse
        self.clicks += key == "LEFTMOUSE"
        for modifier in modifiers:
            self.hand.event_simulate(type=MODIFIERS[modifier], value="PRESS", x=x, y=y)
        self.hand.event_simulate(type=key, value="PRESS", unicode=unicode, x=x, y=y, **modifiers)
        yield
        self.hand.event_simulate(type=key, value="RELEASE", x=x, y=y, **modifiers)
        for modifier in modifiers:
            self.hand.event_simulate(type=MODIFIERS[modifier], value="RELEASE", x=x, y=y)
        yield

    def click(self, name: str, place: Place | None = None, of: str = "") -> Steps:
        """Click a button, named by its operator (``bda.build_scenario``), or a field, by its property."""
        yield from self.hover(name, place, of)
        yield from self.press("LEFTMOUSE")

    def fill_in(self, name: str, text: str, place: Place | None = None, of: str = "") -> Steps:
        """Type into a field in place of what it holds."""
        yield from self.click(name, place, of)
        yield from self.replace_text(text)
        yield from self.press("RET")

    def replace_text(self, text: str) -> Steps:
        """Type a text in place of that in the field that is being edited."""
        yield from self.press("A", ctrl=True)
        yield from self.press("BACK_SPACE")
        yield from self.write(text)

    def write(self, text: str) -> Steps:
        """Type a text where the keyboard's letters go, fast."""
        x, y = self.mouse
        for start in range(0, len(text), FAST_LETTERS):
            for letter in text[start : start + FAST_LETTERS]:
                is_letter = letter.isascii() and letter.isalpha()
                key = letter.upper() if is_letter else KEYS.get(letter, "SLASH")
                self.hand.event_simulate(type=key, value="PRESS", unicode=letter, x=x, y=y)
                self.hand.event_simulate(type=key, value="RELEASE", x=x, y=y)
            yield

    def drag(self, start: tuple[int, int], end: tuple[int, int], button: str = "LEFTMOUSE", **modifiers: bool) -> Steps:
        """Press a button of the mouse in one place, and let it go in another."""
        yield from self.move(*start)
        self.hand.event_simulate(type=button, value="PRESS", x=start[0], y=start[1], **modifiers)
        yield 0.1
        for step in range(1, DRAG_STEPS + 1):
            share = step / DRAG_STEPS
            yield from self.move(*(round(a + share * (b - a)) for a, b in zip(start, end, strict=True)))
        self.hand.event_simulate(type=button, value="RELEASE", x=end[0], y=end[1])
        yield 0.2

    def hover(self, name: str, place: Place | None = None, of: str = "") -> Steps:
        """Move the mouse about until it is over a button or field, and leave it there.

        Parameters
        ----------
        name
            Operator of the button, or property of the field.
        place
            Where to look: the sidebar, which is scrolled for what lies beyond its edges, unless given.
        of
            Name of the object whose property it is, for one of several rows.

        Raises
        ------
        LookupError
            There is none to be seen.
        """
        for number in range(SCROLLS + 2):  # as the sidebar is, from its top, and further down
            region = (place or self._sidebar_place).region
            top = self.looks_from if number == 0 and not place else None
            for x, y in [*self._approach(name, of), *_probes(region, top)]:
                yield from self.move(x, y)
                if name != self._under_mouse(place or self._sidebar_place, of):
                    continue
                yield from self.move(x, y - PROBE_PX // 2)  # off the button's edge
                yield from self.move(x + 1, y - PROBE_PX // 2)
                # The mouse may only now have left the button that it was over before.
                if name == self._under_mouse(place or self._sidebar_place, of):
                    self._seen[name, of] = (x, y)
                    return
            if place:
                break
            yield from (self.scroll_to_top() if number == 0 else self.scroll(NOTCHES))
        raise LookupError(f"there is no {name} {of} to be seen")

    def _approach(self, name: str, of: str) -> list[tuple[int, int]]:
        """The way to where a button was the last time; none where it was not seen yet."""
        if (name, of) not in self._seen:
            return []
        x, y = self._seen[name, of]
        return [(x, y + 2 * PROBE_PX), (x, y), (x + 1, y)]

    def scroll(self, notches: int) -> Steps:
        """Turn the wheel over the sidebar, downwards, or upwards for less than none."""
        sidebar = self.sidebar
        # On the margin: over a list the wheel turns that.
        yield from self.move(sidebar.x + MARGIN_PX, sidebar.y + sidebar.height // 2)
        for _ in range(abs(notches)):
            yield from self.press("WHEELDOWNMOUSE" if notches > 0 else "WHEELUPMOUSE")

    def scroll_to_top(self) -> Steps:
        """Turn the wheel over the sidebar upwards until nothing is above what it shows."""
        for _ in range(TO_THE_END):
            if self.sidebar.view2d.region_to_view(0, self.sidebar.height - 1)[1] > -AT_THE_TOP_PX:
                return
            yield from self.scroll(-1)
            yield 0.05

    def wait_for(self, what: str, happens: Callable[[], bool], seconds: float = 30.0) -> Steps:
        """Wait until something happens, and note if it does not."""
        turns = int(seconds / 0.1)
        for _ in range(turns):
            if happens():
                return
            yield 0.1
        self.note(what, f"not within {seconds:g} s")

    # What is kept of it

    def expect(self, what: str, found: Any, expected: Any = True) -> None:
        """Note whether something is as it should be."""
        self.note(what, "" if found == expected else f"expected {expected!r}, found {found!r}")

    def expect_reports(self, what: str, *parts: str) -> None:
        """Note whether just these reports came since the last look: one with each part in it, in their order."""
        reports = self.take_reports()
        as_expected = len(reports) == len(parts) and all(map(str.__contains__, reports, parts))
        self.note(what, "" if as_expected else f"expected were {parts}, reported was {reports}")

    def note(self, what: str, trouble: str = "") -> None:
        """Note that something is as it should be, or in what it is not."""
        with (self.folder / "checks.jsonl").open("a", encoding="utf-8") as file:
            file.write(json.dumps([what, trouble]) + "\n")

    def picture(self, name: str) -> Steps:
        """Keep a screenshot, when Blender has drawn what there is."""
        yield 0.5
        self._pictures += 1
        path = self.folder / f"{self._pictures:02}_{name}.png"
        subprocess.run(["import", "-window", "root", str(path)], check=True)

    def illustrate(self, name: str, *parts: bpy.types.Area | bpy.types.Region | Part) -> Steps:
        """Keep a screenshot, and in it the picture of that name for the walk-through: what spans some parts."""
        yield from self.picture(name)
        pictures = self.folder / PICTURES
        pictures.mkdir(exist_ok=True)
        left, bottom = min(part.x for part in parts), min(part.y for part in parts)
        right, top = max(part.x + part.width for part in parts), max(part.y + part.height for part in parts)
        crop = ("-crop", f"{right - left}x{top - bottom}+{left}+{self.window.height - top}", "+repage")
        small = ("-dither", "None", "-colors", str(PICTURE_COLOURS), "-strip", "-quality", "90")
        subprocess.run(["import", "-window", "root", *crop, *small, f"png8:{pictures / name}.png"], check=True)

    def _area(self, kind: str) -> bpy.types.Area:
        return next(area for area in self.window.screen.areas if area.type == kind)

    @property
    def _sidebar_place(self) -> Place:
        return Place(self.window, self.view, self.sidebar)

    def in_sidebar(self) -> Any:
        return bpy.context.temp_override(window=self.window, area=self.view, region=self.sidebar)

    def _under_mouse(self, place: Place, of: str) -> str:
        """Name of the button's operator or of the field's property that is under the mouse, empty over neither.

        Of fields, only those of an object count where its name is given.
        """
        with bpy.context.temp_override(window=place.window, area=place.area, region=place.region):
            if bpy.ops.ui.copy_python_command_button.poll():
                bpy.ops.ui.copy_python_command_button()
                return bpy.context.window_manager.clipboard.removeprefix("bpy.ops.").partition("(")[0]
            found = bpy.context.property
        if not found or (of and found[0].name != of):
            return ""
        return found[1].rpartition(".")[2]


def _probes(region: bpy.types.Region, top: int | None) -> Iterator[tuple[int, int]]:
    """Places where the mouse looks for a button, from top to bottom, in one column after the other."""
    for column in PROBE_COLUMNS:
        for y in range(top or region.y + region.height - PROBE_PX // 2, region.y + FOOT_PX, -PROBE_PX):
            yield region.x + int(column * region.width), y


def region_of(area: bpy.types.Area, kind: str) -> bpy.types.Region:
    return next(region for region in area.regions if region.type == kind)
