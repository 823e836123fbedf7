# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps that damage the folder of a run, of which a report is then made."""

from __future__ import annotations

import io
import json
import os
import shutil
import zipfile
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
from matplotlib.image import imsave
from support.run_folders import TOLD, flying_shards, keep_run

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.results.arrays import RESULTS_FILE, load_results
from bridge_demolition_addon.model.run_folder.files import (
    BREAKING_LOG,
    FORCE_LOG,
    PICTURE_FOLDER,
    PICTURES,
    REPORT_PAGE,
    SCENARIO_FILE,
    SUMMARY_FILE,
)

from .sequences import Player, WrongError

FILES = (
    *(RESULTS_FILE, SUMMARY_FILE, SCENARIO_FILE, FORCE_LOG, BREAKING_LOG),
    *(f"{PICTURE_FOLDER}/{name}.png" for name in PICTURES),
)
NUMBERS = (0.0, -1.0, 1e-300, 1e9, -1e300, np.inf, np.nan)
TEXTS = ("", "x", "\udcfc", "$_{")
VALUES: tuple[Any, ...] = (None, True, 0, -1, 10**400, *NUMBERS, *TEXTS, [], [[]], {}, {"time_s": "x"})
KINDS = ("f4", "f8", "i8", "u1", "?", "U3", "c16", "M8[s]", "O")


class FolderPlayer(Player):
    """Someone who spoils what a run has left."""

    weights = {  # noqa: RUF012
        "flip_bytes": 10,
        "cut_off": 8,
        "put_something_else": 8,
        "remove_file": 6,
        "exchange_files": 3,
        "change_array": 30,
        "change_summary": 20,
        "change_log": 12,
    }
    last = ("load", "report")

    def __init__(self, folder: Path, *, bare: bool = False):
        super().__init__(folder, bare=bare)
        self.run = folder / "run"
        shutil.copytree(_whole_run(), self.run)

    def flip_bytes(self, random: Random) -> str:
        path = self._file(random)
        content = bytearray(path.read_bytes())
        for _ in range(random.randint(1, 8)):
            content[random.randrange(len(content))] = random.randrange(256)
        path.write_bytes(content)
        return path.name

    def cut_off(self, random: Random) -> str:
        path = self._file(random)
        os.truncate(path, random.randrange(path.stat().st_size + 1))
        return path.name

    def put_something_else(self, random: Random) -> str:
        path = self._file(random)
        path.unlink()
        number = random.randrange(5)
        if number == 0:
            os.mkfifo(path)
        elif number == 1:
            path.mkdir()
        elif number == 2:
            path.symlink_to(random.choice(("/dev/zero", "/dev/full", path.name, "nowhere")))
        elif number == 3:
            path.write_bytes(b"[" * 10**5)
        else:
            path.write_bytes(random.randbytes(random.randrange(1000)))
        return f"{path.name}, {number}"

    def remove_file(self, random: Random) -> str:
        path = self._file(random)
        path.unlink()
        return path.name

    def exchange_files(self, random: Random) -> str:
        first, second = self._file(random), self._file(random)
        contents = first.read_bytes(), second.read_bytes()
        first.write_bytes(contents[1])
        second.write_bytes(contents[0])
        return f"{first.name} and {second.name}"

    def change_array(self, random: Random) -> str:
        path = self._regular_file(RESULTS_FILE)
        with np.load(path) as stored:
            arrays = dict(stored)
        name = random.choice(list(arrays))
        number = random.randrange(7)
        arrays[name] = _changed(arrays[name], number, random)
        if random.random() < 0.1:
            del arrays[name]
        with zipfile.ZipFile(path, "w") as archive:
            for array, values in arrays.items():
                content = io.BytesIO()
                np.lib.format.write_array(content, np.asanyarray(values))
                archive.writestr(f"{array}.npy", content.getvalue())
        return f"{name}, {number}"

    def change_summary(self, random: Random) -> str:
        path = self._regular_file(SUMMARY_FILE)
        summary = json.loads(path.read_text(encoding="utf-8"))
        table, name = summary, random.choice(list(summary))
        while isinstance(table[name], dict) and table[name] and random.random() < 0.7:
            table = table[name]
            name = random.choice(list(table))
        table[name] = random.choice(VALUES)
        path.write_text(json.dumps(summary), encoding="utf-8")
        return f"{name} = {table[name]!r:.20}"

    def change_log(self, random: Random) -> str:
        (self.run / RESULTS_FILE).unlink(missing_ok=True)
        path = self._regular_file(FORCE_LOG)
        rows = [line.split(",") for line in path.read_text(encoding="utf-8").split("\n")]
        row = random.choice(rows)
        row[random.randrange(len(row))] = random.choice(
            ("", "nan", "1e999", "x", '"', "\0", "x" * 200_000, "-1", "a,b")
        )
        path.write_text("\n".join(map(",".join, rows)), encoding="utf-8")
        return str(row)[:60]

    def load(self, _random: Random) -> str:
        try:
            load_results(self.run / RESULTS_FILE)
        except OutputError as error:
            return str(error)
        return "loaded"

    def report(self, _random: Random) -> str:
        status = main(["report", str(self.run), "--quiet"])
        if status not in (0, 1, 2):
            raise WrongError(f"a report ends with status {status}")
        if status == 0 and not (self.run / REPORT_PAGE).is_file():
            raise WrongError("a report ends well, and is not there")
        return str(status)

    def _regular_file(self, name: str) -> Path:
        """Return a file that can be changed: a pipe never ends, and a device that a link leads to has no end."""
        path = self.run / name
        if not path.is_file():
            raise FileNotFoundError(path)
        return path

    def _file(self, random: Random) -> Path:
        return random.choice([self.run / name for name in FILES if (self.run / name).is_file()])


@cache
def _whole_run() -> Path:
    """Return a folder as a run leaves it, made when it is asked for first."""
    folder = keep_run(Path.cwd().parent / "whole", flying_shards(6, 13), TOLD)
    lines = ["time_s,body,peak_force_sum_N,peak_force_N"]
    lines += [f"{0.1 * frame},{body},{frame * 10.0},1.5" for frame in range(5) for body in ("Ground", "Shard 1")]
    (folder / FORCE_LOG).write_text("\n".join(lines) + "\n", encoding="utf-8")
    (folder / BREAKING_LOG).write_text("time_s,connection\n0.1,Connection.001\n", encoding="utf-8")
    (folder / PICTURE_FOLDER).mkdir()
    for name in PICTURES:
        imsave(folder / PICTURE_FOLDER / f"{name}.png", np.full((9, 16, 3), 0.5))
    return folder


def _changed(array: np.ndarray, number: int, random: Random) -> np.ndarray:
    if number == 0:
        return array.astype(random.choice(KINDS))
    if number == 1:
        return array[: len(array) // 2]
    if number == 2:
        return array[..., None] if random.random() < 0.5 else array[..., :1]
    if number == 3:
        return np.full_like(array, random.choice(NUMBERS) if array.dtype.kind == "f" else random.choice((0, 1, 2**30)))
    if number == 4:
        return np.concatenate([array, array])
    if number == 5:
        return array[::-1]
    changed = array.copy()
    position = tuple(random.randrange(size) for size in array.shape)
    changed[position] = random.choice(NUMBERS) if array.dtype.kind == "f" else random.choice((0, 1, 2**30))
    return changed
