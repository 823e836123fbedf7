# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps that spoil a scenario file, which is then checked and, where that takes no time, run."""

from __future__ import annotations

import tomllib
from pathlib import Path
from random import Random

import numpy as np
from support.checkout import DEMOLITIONS, SMALL, TESTS
from support.random_scenarios import varied

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.errors import DemolitionError
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text

from .sequences import Player, WrongError

SOURCES = (SMALL, TESTS / "simulation" / "everything.toml", *DEMOLITIONS.values())
NUMBERS = ("0", "-1", "1", "1e-300", "1e9", "-1e300", "inf", "nan", "9" * 400, "1_0", "true", "2026-01-01")
TEXTS = ('""', '"x"', '"\\u0000"', '"50% of $1 {x}"', '"/dev/zero"', '"."')
LISTS = ("[]", "[0, 0, 0]", "[[[]]]", "{}", "{ a = 1 }")
MOST_SHARDS, MOST_FRAMES = 60, 40


class ScenarioPlayer(Player):
    """Someone who edits a scenario file without looking."""

    weights = {  # noqa: RUF012
        "change_value": 30,
        "vary_values": 10,
        "remove_line": 10,
        "double_line": 5,
        "exchange_lines": 5,
        "misspell": 5,
        "join_with_another": 4,
        "base_on": 2,
        "flip_byte": 3,
        "cut_off": 1,
    }
    first = ("choose_file",)
    last = ("check", "run")

    def __init__(self, folder: Path, *, bare: bool = False):
        super().__init__(folder, bare=bare)
        self.path = folder / "scenario.toml"
        self.content = b""

    def choose_file(self, random: Random) -> str:
        source = random.choice(SOURCES)
        self.content = scenario_text(read_scenario(source)).encode()
        return source.name

    def change_value(self, random: Random) -> str:
        lines = self._lines()
        row = random.choice([row for row, line in enumerate(lines) if b" = " in line])
        key = lines[row].split(b" = ")[0]
        lines[row] = key + b" = " + random.choice(NUMBERS + TEXTS + LISTS).encode()
        return self._write(lines, lines[row])

    def vary_values(self, random: Random) -> str:
        """Where the file is right, it stays so."""
        try:
            tomllib.loads(self.content.decode())
            self.path.write_bytes(self.content)
            scenario = read_scenario(self.path)
        except (DemolitionError, ValueError, RecursionError):
            return "is wrong already"
        changes = random.randint(1, 10)
        self.content = scenario_text(varied(scenario, np.random.default_rng(random.getrandbits(32)), changes)).encode()
        return str(changes)

    def remove_line(self, random: Random) -> str:
        lines = self._lines()
        return self._write(lines, lines.pop(random.randrange(len(lines))))

    def double_line(self, random: Random) -> str:
        lines = self._lines()
        row = random.randrange(len(lines))
        lines.insert(row, lines[row])
        return self._write(lines, lines[row])

    def exchange_lines(self, random: Random) -> str:
        lines = self._lines()
        first, second = (random.randrange(len(lines)) for _ in range(2))
        lines[first], lines[second] = lines[second], lines[first]
        return self._write(lines, lines[first] + b" and " + lines[second])

    def misspell(self, random: Random) -> str:
        lines = self._lines()
        row = random.randrange(len(lines))
        position = random.randint(0, len(lines[row]))
        lines[row] = (
            lines[row][:position] + random.choice((b"x", b".", b"[", b'"', b"\xff")) + lines[row][position + 1 :]
        )
        return self._write(lines, lines[row])

    def join_with_another(self, random: Random) -> str:
        source = random.choice(SOURCES)
        tables = scenario_text(read_scenario(source)).split("\n\n")
        table = random.choice(tables)
        self.content += b"\n\n" + table.encode()
        return table.split("\n")[0]

    def base_on(self, random: Random) -> str:
        base = random.choice((str(self.path), str(SMALL), "missing.toml", str(self.folder), "/dev/zero"))
        return self._write([b"[scenario]", f'based_on = "{base}"'.encode(), *self._lines()[1:]], base.encode())

    def flip_byte(self, random: Random) -> str:
        position = random.randrange(len(self.content))
        self.content = self.content[:position] + random.randbytes(1) + self.content[position + 1 :]
        return str(position)

    def cut_off(self, random: Random) -> str:
        self.content = self.content[: random.randrange(len(self.content))] or b"\n"
        return str(len(self.content))

    def check(self, _random: Random) -> str:
        self.path.write_bytes(self.content)
        scenario = self._scenario()
        if scenario is None or scenario.fracture.shards <= 50 * MOST_SHARDS:  # more take a minute
            self._status("check", str(self.path))
        return "right" if scenario else "wrong"

    def run(self, _random: Random) -> str:
        scenario = self._scenario()
        if scenario is None or not _is_short(scenario):
            return "not run"
        output = str(self.folder / "results")
        return str(self._status("run", str(self.path), "--output", output, "--no-pictures", "--quiet"))

    def _scenario(self) -> Scenario | None:
        try:
            return read_scenario(self.path)
        except DemolitionError:
            return None

    def _status(self, *arguments: str) -> int:
        status = main(arguments)
        if status not in (0, 1, 2):
            raise WrongError(f"{arguments}: ends with status {status}")
        return status

    def _lines(self) -> list[bytes]:
        return self.content.split(b"\n")

    def _write(self, lines: list[bytes], told: bytes) -> str:
        self.content = b"\n".join(lines)
        return told.decode("utf-8", "replace")


def _is_short(scenario: Scenario) -> bool:
    """Return whether a run takes a moment."""
    steps = len(scenario.timeline) * scenario.time.substeps_per_frame
    return (
        scenario.fracture.shards <= MOST_SHARDS
        and len(scenario.timeline) <= MOST_FRAMES
        and steps * scenario.time.solver_iterations <= MOST_FRAMES * 1000
    )
