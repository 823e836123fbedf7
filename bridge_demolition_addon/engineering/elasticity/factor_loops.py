"""Factors LDLᵀ of symmetric equations as loops, which Numba compiles: import this only where it is installed.

They do the operations of QDLDL in its order, and give its bits. It finds row after row of L, of which each number takes
part once for every number of a row; here up to six rows are found together, where they hang on the same columns in the
same order: those of a body mostly do. Six such columns are a panel, with the same rows below.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compilation import compiled

_WIDTH = 6
"""Most rows, or columns, of a panel: the unknowns of a body."""


@compiled
def permuted(starts: Any, rows: Any, order: Any) -> Any:
    """Return an upper triangle in another order: starts of its columns, rows, and where each number was.

    Numbers of a column are in the order in which QDLDL has them.
    """
    count, place = len(order), np.empty(len(order), np.int64)
    for number in range(count):
        place[order[number]] = number
    new_starts = np.zeros(count + 1, np.int64)
    for column in range(count):
        for at in range(starts[column], starts[column + 1]):
            new_starts[max(place[rows[at]], place[column]) + 1] += 1
    for column in range(count):
        new_starts[column + 1] += new_starts[column]
    following, new_rows, sources = new_starts[:-1].copy(), np.empty(len(rows), np.int64), np.empty(len(rows), np.int64)
    for column in range(count):
        for at in range(starts[column], starts[column + 1]):
            one, other = place[rows[at]], place[column]
            to = following[max(one, other)]
            new_rows[to], sources[to] = min(one, other), at
            following[max(one, other)] += 1
    return new_starts, new_rows, sources


@compiled
def elimination_tree(starts: Any, rows: Any) -> Any:
    """Return the parent of each column, -1 for none, and how many numbers of L are below it."""
    count = len(starts) - 1
    parents, below, seen = np.full(count, -1), np.zeros(count, np.int64), np.full(count, -1)
    for column in range(count):
        seen[column] = column
        for at in range(starts[column], starts[column + 1]):
            row = rows[at]
            while seen[row] != column:
                if parents[row] == -1:
                    parents[row] = column
                below[row] += 1
                seen[row] = column
                row = parents[row]
    return parents, below


@compiled
def columns_of_rows(starts: Any, rows: Any, parents: Any, below: Any) -> Any:
    """Return, for each row of L, its columns in the order in which QDLDL goes through them: starts, and columns."""
    count = len(parents)
    columns, found_starts = np.empty(below.sum(), np.int64), np.zeros(count + 1, np.int64)
    seen, path, found = np.full(count, -1), np.empty(count, np.int64), np.empty(count, np.int64)
    for row in range(count):
        length = 0
        for at in range(starts[row], starts[row + 1]):
            column, steps = rows[at], 0
            while column != -1 and column < row and seen[column] != row:
                seen[column] = row
                path[steps] = column
                steps += 1
                column = parents[column]
            for step in range(steps - 1, -1, -1):
                found[length] = path[step]
                length += 1
        start = found_starts[row]
        for number in range(length):
            columns[start + number] = found[length - 1 - number]
        found_starts[row + 1] = start + length
    return found_starts, columns


@compiled
def panels(parents: Any, below: Any, starts: Any, columns: Any) -> Any:
    """Return where panels start (p + 1,), with the number of unknowns as the last."""
    count = len(parents)
    found, panel_count = np.empty(count + 1, np.int64), 0
    for column in range(count):
        first = found[panel_count - 1] if panel_count else 0
        joins = 0 < column - first < _WIDTH and parents[column - 1] == column and below[column - 1] == below[column] + 1
        if joins:
            shared, own = starts[first + 1] - starts[first], starts[column + 1] - starts[column]
            joins = own == shared + column - first
            for number in range(own if joins else 0):
                here = columns[starts[column] + number]
                expected = columns[starts[first] + number] if number < shared else first + number - shared
                joins = joins and here == expected
        if not joins:
            found[panel_count] = column
            panel_count += 1
    found[panel_count] = count
    return found[: panel_count + 1].copy()


@compiled
def stretches(panel_starts: Any, starts: Any, columns: Any) -> Any:
    """Return, for each panel as rows, through which columns of other panels it goes together, in order.

    Starts (p + 1,), and panels, first and last columns in these (s, 3).
    """
    count = len(panel_starts) - 1
    panel_of = np.empty(panel_starts[-1], np.int64)
    for panel in range(count):
        panel_of[panel_starts[panel] : panel_starts[panel + 1]] = panel
    found, found_starts, length = np.empty((len(columns), 3), np.int64), np.zeros(count + 1, np.int64), 0
    for panel in range(count):
        row = panel_starts[panel]
        for at in range(starts[row], starts[row + 1]):
            of = panel_of[columns[at]]
            within = columns[at] - panel_starts[of]
            if length > found_starts[panel] and found[length - 1, 0] == of and found[length - 1, 2] == within - 1:
                found[length - 1, 2] = within
            else:
                found[length, 0], found[length, 1], found[length, 2] = of, within, within
                length += 1
        found_starts[panel + 1] = length
    return found_starts, found[:length].copy()


@compiled
def rows_below(panel_starts: Any, stretch_starts: Any, stretches: Any) -> Any:
    """Return the rows below each panel: starts (p + 1,), and rows."""
    count = len(panel_starts) - 1
    starts = np.zeros(count + 1, np.int64)
    for panel in range(count):
        for at in range(stretch_starts[panel], stretch_starts[panel + 1]):
            if stretches[at, 1] == 0:
                starts[stretches[at, 0] + 1] += panel_starts[panel + 1] - panel_starts[panel]
    for panel in range(count):
        starts[panel + 1] += starts[panel]
    rows, following = np.empty(starts[-1], np.uint32), starts[:-1].copy()
    for panel in range(count):
        for at in range(stretch_starts[panel], stretch_starts[panel + 1]):
            of = stretches[at, 0]
            if stretches[at, 1] == 0:
                for row in range(panel_starts[panel], panel_starts[panel + 1]):
                    rows[following[of]] = row
                    following[of] += 1
    return starts, rows


@compiled
def factor(
    data: Any,
    entry_starts: Any,
    entry_rows: Any,
    sources: Any,
    panel_starts: Any,
    stretch_starts: Any,
    stretches: Any,
    starts: Any,
    rows: Any,
    within: Any,
    below: Any,
    inverse: Any,
) -> None:
    """Write the numbers of L within panels (p, 6, 6) and below them (r, 6), and the inverse of D (n,)."""
    count, size = len(panel_starts) - 1, panel_starts[-1]
    lines, filled = np.zeros((size, _WIDTH)), starts[:-1].copy()
    lead, diagonal = np.zeros((_WIDTH, _WIDTH)), np.empty(_WIDTH)
    for panel in range(count):
        first, width = panel_starts[panel], panel_starts[panel + 1] - panel_starts[panel]
        for lane in range(width):
            for at in range(entry_starts[first + lane], entry_starts[first + lane + 1]):
                if entry_rows[at] == first + lane:
                    diagonal[lane] = data[sources[at]]
                else:
                    lines[entry_rows[at], lane] = data[sources[at]]
        for at in range(stretch_starts[panel], stretch_starts[panel + 1]):
            of, begin, end = stretches[at, 0], stretches[at, 1], stretches[at, 2] + 1
            column = panel_starts[of]
            _lead(lines, within[of], column, panel_starts[of + 1] - column, begin, end, lead)
            found = slice(starts[of], filled[of])
            if begin == 0 and end == _WIDTH:
                _subtract(lines, rows[found], below[found], lead)
            else:
                _subtract_some(lines, rows[found], below[found], begin, end, lead)
            _found(lines, below, filled[of], first, width, column, begin, end, lead, inverse, diagonal)
        for at in range(stretch_starts[panel], stretch_starts[panel + 1]):
            if stretches[at, 1] == 0:
                filled[stretches[at, 0]] += width
        _finish(lines, within[panel], first, width, inverse, diagonal)


@compiled
def _lead(lines: Any, within: Any, column: int, width: int, begin: int, end: int, lead: Any) -> None:
    """Take some columns of a panel out of lines, which they have changed within the panel."""
    for number in range(begin, end):
        for lane in range(_WIDTH):
            lead[number, lane] = lines[column + number, lane]
            lines[column + number, lane] = 0.0
        for row in range(number + 1, width):
            for lane in range(_WIDTH):
                lines[column + row, lane] -= within[row, number] * lead[number, lane]


@compiled
def _subtract(lines: Any, rows: Any, below: Any, lead: Any) -> None:
    """Subtract what the six columns of a panel do to the rows below that are found, one column after another."""
    for at in range(len(rows)):
        line, one, two, three = lines[rows[at]], below[at, 0], below[at, 1], below[at, 2]
        four, five, six = below[at, 3], below[at, 4], below[at, 5]
        for lane in range(_WIDTH):
            line[lane] = (
                line[lane]
                - one * lead[0, lane]
                - two * lead[1, lane]
                - three * lead[2, lane]
                - four * lead[3, lane]
                - five * lead[4, lane]
                - six * lead[5, lane]
            )


@compiled
def _subtract_some(lines: Any, rows: Any, below: Any, begin: int, end: int, lead: Any) -> None:
    """`_subtract` for some columns."""
    for at in range(len(rows)):
        line = lines[rows[at]]
        for number in range(begin, end):
            share = below[at, number]
            for lane in range(_WIDTH):
                line[lane] -= share * lead[number, lane]


@compiled
def _found(
    lines: Any,
    below: Any,
    at: int,
    first: int,
    width: int,
    column: int,
    begin: int,
    end: int,
    lead: Any,
    inverse: Any,
    diagonal: Any,
) -> None:
    """Write the numbers of rows in some columns, and subtract what they do to each other."""
    for number in range(begin, end):
        for lane in range(width):
            below[at + lane, number] = lead[number, lane] * inverse[column + number]
            diagonal[lane] -= lead[number, lane] * below[at + lane, number]
            for row in range(lane):
                lines[first + row, lane] -= below[at + row, number] * lead[number, lane]


@compiled
def _finish(lines: Any, within: Any, first: int, width: int, inverse: Any, diagonal: Any) -> None:
    """Find the numbers of a panel within itself, and leave its lines empty."""
    for column in range(width):
        inverse[first + column] = 1.0 / diagonal[column]
        for lane in range(column + 1, width):
            number = lines[first + column, lane]
            for row in range(column + 1, lane):
                lines[first + row, lane] -= within[row, column] * number
            within[lane, column] = number * inverse[first + column]
            diagonal[lane] -= number * within[lane, column]
            lines[first + column, lane] = 0.0


@compiled
def solved(
    right: Any, order: Any, panel_starts: Any, starts: Any, rows: Any, within: Any, below: Any, inverse: Any
) -> Any:
    """Return the unknowns (6, b) for a right-hand side (6, b)."""
    size, count = len(order), len(panel_starts) - 1
    values, unknowns = np.empty(size), np.empty(right.shape)
    for number in range(size):
        values[number] = right[order[number] % _WIDTH, order[number] // _WIDTH]
    for panel in range(count):
        first, width = panel_starts[panel], panel_starts[panel + 1] - panel_starts[panel]
        for column in range(width):
            for row in range(column + 1, width):
                values[first + row] -= within[panel, row, column] * values[first + column]
        _forward(values, first, width, starts[panel], starts[panel + 1], rows, below)
    for number in range(size):
        values[number] *= inverse[number]
    for panel in range(count - 1, -1, -1):
        first, width = panel_starts[panel], panel_starts[panel + 1] - panel_starts[panel]
        for column in range(width - 1, -1, -1):
            value = values[first + column]
            for row in range(column + 1, width):
                value -= within[panel, row, column] * values[first + row]
            for at in range(starts[panel], starts[panel + 1]):
                value -= below[at, column] * values[rows[at]]
            values[first + column] = value
    for number in range(size):
        unknowns[order[number] % _WIDTH, order[number] // _WIDTH] = values[number]
    return unknowns


@compiled
def _forward(values: Any, first: int, width: int, start: int, end: int, rows: Any, below: Any) -> None:
    """Subtract what the unknowns of a panel do to rows below."""
    if width == _WIDTH:
        one, two, three = values[first], values[first + 1], values[first + 2]
        four, five, six = values[first + 3], values[first + 4], values[first + 5]
        for at in range(start, end):
            values[rows[at]] = (
                values[rows[at]]
                - below[at, 0] * one
                - below[at, 1] * two
                - below[at, 2] * three
                - below[at, 3] * four
                - below[at, 4] * five
                - below[at, 5] * six
            )
    else:
        for at in range(start, end):
            for column in range(width):
                values[rows[at]] -= below[at, column] * values[first + column]
