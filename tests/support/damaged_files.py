# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that were damaged at random, as by a bad disk, a broken export or an editor."""

import random
import re

_REFERENCE = re.compile(rb"#\d+")
_ATTRIBUTE = re.compile(rb"[(,]((?:'[^'\n]*'|#\d+|\.\w+\.|-?\d[\d.E+-]*|\(\#\d+(?:,#\d+)*\)))(?=[,)])")
_SCHEMA = re.compile(rb"FILE_SCHEMA\s*\(\s*\(\s*'[^']*'")
_SCHEMAS = (
    *(b"IFC4X3", b"IFC4", b"IFC2X3", b"IFC4X1", b"IFC4_ADD2_TC1", b"IFC2X3_TC1", b"IFC4X3_RC2", b"ifc4x3_add2"),
    *(b"IFC4X3_DEV_62d5", b"IFC9", b"", b"CONFIG_CONTROL_DESIGN"),
)
_LARGE = 200_000
_NUMBER = re.compile(rb"-?\d+\.\d*(?:E[+-]?\d+)?")


def damaged(content: bytes, seed: int) -> bytes:
    """The content of a file with a few places damaged, the same for the same seed."""
    return _changed(content, seed, _WAYS)


def mutated(content: bytes, seed: int) -> bytes:
    """The content of an IFC file as a program might have written it that contradicts its schema."""
    return _changed(content, seed, _MUTATIONS)


def _changed(content, seed, ways):
    chance = random.Random(seed)
    for _ in range(chance.randint(1, 4)):
        content = chance.choice(ways)(content, chance)
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


def _lines_lost(content, chance):
    """Some lines of a file at once, from one in a thousand to one in fifty."""
    part = chance.choice((0.001, 0.005, 0.02))
    return b"\n".join(line for line in content.split(b"\n") if chance.random() > part or b"ISO-10303" in line)


def _values_null(content, chance):
    """One to thirty attributes of IFC statements become $, whatever they are."""
    for _ in range(chance.randint(1, 30)):
        found = list(_ATTRIBUTE.finditer(content)) if len(content) < _LARGE else _some(_ATTRIBUTE, content, chance)
        if not found:
            return content
        one = chance.choice(found)
        content = content[: one.start(1)] + b"$" + content[one.end(1) :]
    return content


def _schema_renamed(content, chance):
    return _SCHEMA.sub(b"FILE_SCHEMA(('" + chance.choice(_SCHEMAS) + b"'", content, count=1)


def _some(pattern, content, chance):
    """Matches of a pattern near a random position of a large file."""
    at = chance.randrange(len(content) - _LARGE // 2)
    return [pattern.match(content, one.start()) for one in pattern.finditer(content, at, at + _LARGE // 2)]


_WAYS = (
    _bytes_lost,
    _bytes_changed,
    _cut_short,
    _line_lost,
    _line_doubled,
    *3 * (_other(_REFERENCE, lambda found, chance: chance.choice((chance.choice(found).group(), b"$", b"#0"))),),
    *3 * (_other(_NUMBER, lambda _found, chance: chance.choice((b"0.", b"-1.", b"1.E300", b"NAN", b"1.E-300"))),),
)

_MUTATIONS = (_lines_lost, *2 * (_values_null,), _schema_renamed, *_WAYS[5:8])
