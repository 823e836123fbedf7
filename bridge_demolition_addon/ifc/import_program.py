"""The program that imports a bridge: see `import_process`, which starts it, and starts it again where it crashed.

It reads a request from its standard input, one line of JSON, and answers with lines of JSON behind `MARK` on what its
standard output was: what the libraries print there goes nowhere.
"""

from __future__ import annotations

import json
import os
import sys
import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from ..errors import DemolitionError, text_of
from .bridge import read_bridge
from .element_materials import material_table, substances
from .elements import Element, elements_of
from .folder import write_bridge
from .import_process import MARK
from .settings import ImportSettings
from .several_bridges import bridges_in
from .shapes import KeptShapes
from .source import naming_contradictions, open_source

Say = Callable[[Mapping[str, Any]], None]


def main() -> None:
    """Do what the request asks for, and answer with what was done, or with what is wrong."""
    say = _sayer()
    request = json.loads(sys.stdin.readline())
    try:
        say({"done": _listed(request) if request["is_listing"] else _imported(request, say)})
    except (DemolitionError, OSError) as error:
        say({"refused": type(error).__name__, "text": text_of(error)})
    except MemoryError:
        say({"refused": "IfcError", "text": f"{request['path']}: needs more memory than there is; leave elements out"})
    except Exception as error:  # said as a fault of ours, in one sentence: a file of another program led to it
        frame = traceback.extract_tb(error.__traceback__)[-1]
        say({"fault": f"{type(error).__name__} in {Path(frame.filename).name}, line {frame.lineno}: {error}"})


def _imported(request: Mapping[str, Any], say: Say) -> dict[str, Any]:
    """Import a bridge into a folder, and return what is said of it."""
    kept = KeptShapes(Path(request["kept"]), {int(number): why for number, why in request["failed"].items()})

    names = iter(["putting the members together"])

    def begins(done: int, total: int, element: Element | None) -> None:
        if element is None:  # what follows is no element's fault; bodies that take other ways are begun by themselves
            say({"stage": next(names, None)})
            return
        say({"element": element.entity.id(), "title": element.title, "part": done, "of": total})

    kept.begins, kept.says = begins, lambda text: say({"stage": text})
    bridge = read_bridge(Path(request["path"]), ImportSettings.from_json(request["settings"]), kept)
    say({"stage": "writing the scenario"})
    lines = write_bridge(bridge, Path(request["folder"]))
    became = [outcome.became for outcome in bridge.outcomes]
    counts = {word: became.count(word) for word in ("member", "connection", "left out")}
    return {"title": bridge.scenario.title, "lines": lines, "counts": counts}


def _listed(request: Mapping[str, Any]) -> dict[str, Any]:
    """Return the elements of a file, with their kinds and materials, without working out any geometry."""
    path, settings = Path(request["path"]), ImportSettings.from_json(request["settings"])
    with naming_contradictions(path):
        source = open_source(path, settings)
        elements = elements_of(source, settings)
        made_of = substances(
            source, [one for one in elements if one.is_member], material_table(settings.materials), settings
        )
        bridges = bridges_in(source, elements)
    rows = []
    for element in elements:
        substance = made_of.get(element.entity.id())
        rows.append(
            {
                "name": element.facts.name,
                "ifc_class": element.facts.classes[0],
                "global_id": element.facts.global_id,
                "kind": element.member_kind if element.is_member else "",
                "why": element.why_left_out,
                "material": substance.name if substance else "",
                "note": substance.note if substance else "",
                "bridge": next((one.name for one in bridges if one.number in element.wholes), ""),
            }
        )
    return {"elements": rows}


def _sayer() -> Say:
    sys.stdout.flush()
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.close(nowhere)

    def say(answer: Mapping[str, Any]) -> None:
        answers.write(MARK + json.dumps(answer) + "\n")
        answers.flush()

    return say
