"""``bda new``: write a scenario to start from, by six questions or options."""

import argparse
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..errors import OutputError
from ..model.scenario.file import scenario_from_text
from ..model.scenario.starter import METHODS, PIERS, SECTIONS, Answers, starter_text
from ..system.disk import write_whole_text, writing
from .arguments import quantity


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "new",
        description="Write a commented scenario. On a terminal, what no option says is asked for; elsewhere it is what "
        "is in brackets. An empty answer takes that too.",
        allow_abbrev=False,
    )
    parser.add_argument("file", metavar="FILE.toml", type=Path, help="file to write, which must not be there")
    usual = Answers()
    for name, (read, metavar, question) in _QUESTIONS.items():
        shown = _shown(name, getattr(usual, name)).replace("%", "%%")
        option, text = f"--{name.removesuffix('_m')}", f"{question} ({shown})"
        parser.add_argument(option, dest=name, type=read, metavar=metavar, help=text)
    for name, (metavar, meaning) in _OF_THE_ROAD.items():
        parser.add_argument(f"--{name.partition('_')[0]}", dest=name, type=_signed, metavar=metavar, help=meaning)
    for name, (known, meaning) in _KINDS.items():
        text = f"{meaning} ({getattr(usual, name)})"
        parser.add_argument(f"--{name}", choices=tuple(known), metavar="|".join(known), help=text)
    parser.set_defaults(execute=new)


def new(arguments: argparse.Namespace) -> None:
    """Write the scenario, and print what to do with it."""
    file: Path = arguments.file
    if not file.suffix:
        file = file.with_name(f"{file.name}.toml")
    if not file.parent.is_dir():
        raise OutputError(f"{file}: folder {file.parent} is not there; make it first")
    if file.exists():
        raise OutputError(f"{file}: exists already; choose another name")
    names = (*_QUESTIONS, *_OF_THE_ROAD, *_KINDS)
    given = {name: getattr(arguments, name) for name in names if getattr(arguments, name) is not None}
    answers = replace(Answers(), **given)
    if sys.stdin.isatty():
        for name in _QUESTIONS:
            if name not in given:
                answers = _asked(answers, name)
    text = starter_text(answers)
    scenario_from_text(text)  # refuses sizes that do not go together before anything is written
    with writing(file):
        write_whole_text(file, text)
    print(f"{file}\n\nNow: bda check {file}\nThen: bda run {file} --report")


def _asked(answers: Answers, name: str) -> Answers:
    """Return the answers with one that the user types in; ask again where it is wrong."""
    read, _, question = _QUESTIONS[name]
    while True:
        try:
            typed = input(f"{question} [{_shown(name, getattr(answers, name))}]: ").strip()
        except EOFError as error:  # Ctrl-D
            raise KeyboardInterrupt from error
        if not typed:
            return answers
        try:
            return replace(answers, **{name: read(typed)})
        except argparse.ArgumentTypeError as error:
            print(error)


def _shown(name: str, value: Any) -> str:
    if value is None:
        return "a 16th of the longest span"
    return " ".join(f"{span:g}" for span in value) if name == "spans_m" else str(value)


def _length(text: str) -> float:
    return quantity(text.replace(",", "."))


def _signed(text: str) -> float:
    return -_length(text[1:]) if text.startswith("-") else _length(text)


def _spans(text: str) -> tuple[float, ...]:
    """Return lengths that blanks or semicolons separate, so that a decimal comma is one."""
    spans = tuple(_length(part) for part in text.replace(";", " ").split())
    if not spans:
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected lengths in m, such as '15 20 15'")
    return spans


def _method(text: str) -> str:
    if text not in METHODS:
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected one of {', '.join(METHODS)}")
    return text


_QUESTIONS: dict[str, tuple[Callable[[str], Any], str, str]] = {
    "title": (str, "TEXT", "What is the bridge called?"),
    "spans_m": (_spans, "'M M …'", "How long are its spans, in m?"),
    "width_m": (_length, "M", "How wide is its deck, in m?"),
    "thickness_m": (_length, "M", "How thick is its slab, in m?"),
    "height_m": (_length, "M", "How high are its piers, in m?"),
    "by": (_method, "|".join(METHODS), "What brings it down?"),
}
"""Of each answer: how it is read, what stands for it in the help, and the question."""

_OF_THE_ROAD = {
    "grade_percent": ("PERCENT", "slope along the road, above 0 where it rises; the deck is level without it"),
    "crossfall_percent": ("PERCENT", "slope across the road, above 0 where its left side is higher"),
    "radius_m": ("M", "radius of the road in plan, above 0 where it turns to the left; it is straight without it"),
    "haunch_m": ("M", "how much deeper the slab is over inner piers; it is as deep everywhere without it"),
}
"""Of each option that is not asked for: what stands for it in the help, and its meaning."""

_KINDS = {"section": (SECTIONS, "section of the deck"), "piers": (PIERS, "piers")}
"""Of each option that names a kind: which there are, and its meaning."""
