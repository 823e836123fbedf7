# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines of Blender that say nothing are left out; all others appear, also those of the C library, in their streams."""

import sys

import pytest
from support.processes import outcome, run_bda, start

NOISE = [
    'Info: Saved as "scene.blend"',
    'Saved "scene.blend"',
    "00:06.452  render           | Saved: '/tmp/bda_3ba_go3l/before.png'",
    "Saved: '/tmp/bda_3ba_go3l/before.png'",
    " Time: 00:00.11 (Saving: 00:00.02)".strip(),
    "EGL Error (0x3009): EGL_BAD_MATCH: Arguments are inconsistent (for example, a valid context requires buffers).",
]
PROGRAM = """
import ctypes, os, sys
from bridge_demolition_addon.system.native_output import without_noise
library = ctypes.CDLL(None)
lines = {lines!r}
print("before")
with without_noise():
    for line in lines:
        print(line)
        os.write(2, line.encode() + b"\\n")
        library.puts(line.encode())
print("after")
"""


def run_text(program):
    """Run a program: its status, what it printed, and what it complained of."""
    return outcome(start([sys.executable, "-c", program]))


def printed(lines):
    return run_text(PROGRAM.format(lines=lines))


@pytest.mark.skipif("sys.platform == 'win32'", reason="the program takes the C library of Linux")
def test_noise_is_left_out_of_all_streams():
    status, out, err = printed(NOISE)
    assert (status, out.splitlines(), err) == (0, ["before", "after"], "")


@pytest.mark.skipif("sys.platform == 'win32'", reason="the program takes the C library of Linux")
def test_everything_else_is_printed_where_it_belongs():
    said = [
        "EGL Error (0x3003): EGL_BAD_ALLOC: not enough memory",
        "Error: Cannot open file /x/scene.blend for writing: No space left on device",
        "Info: Saved copy",
        "Br\u00fccke",
    ]
    status, out, err = printed([NOISE[0], *said, NOISE[2]])
    assert status == 0
    assert err.splitlines() == said
    assert out.splitlines()[0] == "before" and out.splitlines()[-1] == "after"
    assert sorted(out.splitlines()[1:-1]) == sorted([*said, *said])


def test_an_error_within_passes_with_what_was_printed_before_it():
    status, out, err = run_text(
        "import os\n"
        "from bridge_demolition_addon.system.native_output import without_noise\n"
        "with without_noise():\n"
        "    os.write(1, b'half a line')\n"
        "    raise ValueError('this')\n"
    )
    assert status == 1 and out == "half a line" and err.rstrip().endswith("ValueError: this")


@pytest.mark.long
@pytest.mark.slow
def test_a_run_with_pictures_prints_no_line_of_blender(tmp_path):
    status, out, err = run_bda("run", "docs/small_bridge.toml", "--output", tmp_path / "results")
    assert (status, err) == (0, "")
    assert [line for line in out.splitlines() if "Saved" in line or "EGL" in line] == []
    assert (tmp_path / "results" / "frames" / "before.png").is_file()
