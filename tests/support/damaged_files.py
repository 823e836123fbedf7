# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that were damaged at random, as by a bad disk, a broken export or an editor."""

import random
import re

_REFERENCE = re.compile(rb"#\d+")
_NUMBER = re.compile(rb"-?\d+\.\d*(?:E[+-]?\d+)?")


def damaged(content: bytes, seed: int) -> bytes:
    """The content of a file with a few places damaged, the same for the same seed."""
    chance = random.Random(seed)
    for _ in range(chance.randint(1, 4)):
        content = chance.choice(_WAYS)(content, chance)
    return content


def _bytes_lost(content, chance):
    at = chance.randrange(len(content) or 1)
    return content[:at] + content[at + chance.randint(1, 200) :]


def _bytes_changed(content, chance):
    changed = bytearray(content)
    for _ in range(chance.randint(1, 20)):
        if changed:
            changed[chance.randrange(len(changed))] = chance.randrange(256)
    return bytes(changed)


def _cut_short(content, chance):
    return content[: chance.randrange(len(content) or 1)] + chance.choice((b"", b"\nENDSEC;\nEND-ISO-10303-21;\n"))


def _line_lost(content, chance):
    lines = content.split(b"\n")
    del lines[chance.randrange(len(lines))]
    return b"\n".join(lines)


def _line_doubled(content, chance):
    lines = content.split(b"\n")
    lines.insert(chance.randrange(len(lines)), chance.choice(lines))
    return b"\n".join(lines)


def _other(pattern, choose):
    def change(content, chance):
        found = list(pattern.finditer(content))
        if not found:
            return content
        one = chance.choice(found)
        return content[: one.start()] + choose(found, chance) + content[one.end() :]

    return change


_WAYS = (
    _bytes_lost,
    _bytes_changed,
    _cut_short,
    _line_lost,
    _line_doubled,
    *3 * (_other(_REFERENCE, lambda found, chance: chance.choice((chance.choice(found).group(), b"$", b"#0"))),),
    *3 * (_other(_NUMBER, lambda _found, chance: chance.choice((b"0.", b"-1.", b"1.E300", b"NAN", b"1.E-300"))),),
)
