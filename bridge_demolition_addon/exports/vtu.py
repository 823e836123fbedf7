"""Meshes in the XML files of VTK, version 1.0, which ParaView reads: each array packed by zlib, in base64."""

from __future__ import annotations

import zlib
from base64 import b64encode
from collections.abc import Iterable, Mapping
from math import prod
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np

POINT, TRIANGLE = 1, 5
"""Types of cells."""

_TYPES = {"f4": "Float32", "f8": "Float64", "i4": "Int32", "i8": "Int64", "u1": "UInt8"}
_FAST = 1
"""Level of zlib: higher ones take several times as long for a tenth less."""

_VTKS_BLOCK = 32768
"""Bytes of a block as VTK writes it, which its files name also where there is none."""

_HEAD = '<?xml version="1.0"?>\n<VTKFile type="{}" version="1.0" byte_order="LittleEndian" header_type="UInt64"{}>\n'


class Topology:
    """The cells of a mesh by their points (c, v), all of one type, encoded once for many files."""

    def __init__(self, cells: np.ndarray, cell_type: int):
        count, corners = cells.shape
        self.count = count
        self.text = "".join(
            (
                "<Cells>\n",
                data_array("connectivity", cells.ravel().astype(np.int64)),
                data_array("offsets", np.arange(1, count + 1, dtype=np.int64) * corners),
                data_array("types", np.full(count, cell_type, np.uint8)),
                "</Cells>\n",
            )
        )


def write_vtu(
    path: Path,
    topology: Topology,
    points_m: np.ndarray,
    cell_data: Mapping[str, np.ndarray],
    encoded: Iterable[str] = (),
) -> None:
    """Write one mesh: points (p, 3), in double precision, and arrays (c, …) of its cells by name.

    `encoded` are further arrays of cells, as `data_array` gives them.
    """
    with path.open("w", encoding="ascii", newline="\n") as file:
        file.write(_HEAD.format("UnstructuredGrid", ' compressor="vtkZLibDataCompressor"'))
        file.write(f'<UnstructuredGrid>\n<Piece NumberOfPoints="{len(points_m)}" NumberOfCells="{topology.count}">\n')
        file.write(f"<Points>\n{data_array('Points', points_m.astype(float))}</Points>\n{topology.text}<CellData>\n")
        file.writelines(encoded)
        file.writelines(data_array(name, values) for name, values in cell_data.items())
        file.write("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")


def write_series(path: Path, times_s: Iterable[float], files: Iterable[str]) -> None:
    """Write a collection: the file, relative to its own folder, of each time."""
    lines = (
        f'<DataSet timestep="{float(time)!r}" part="0" file={quoteattr(file)}/>\n'
        for time, file in zip(times_s, files, strict=True)
    )
    text = _HEAD.format("Collection", "") + f"<Collection>\n{''.join(lines)}</Collection>\n</VTKFile>\n"
    path.write_text(text, encoding="utf-8", newline="\n")


def data_array(name: str, values: np.ndarray) -> str:
    """Return an array (c, …) as an element of such a file."""
    kind = values.dtype.newbyteorder("<")
    content = np.ascontiguousarray(values, kind).tobytes()
    packed = zlib.compress(content, _FAST) if content else b""
    # One block, none of them cut short; or none, as VTK itself writes it.
    sizes = np.array([1, len(content), 0, len(packed)] if content else [0, _VTKS_BLOCK, 0], "<u8").tobytes()
    components = f' NumberOfComponents="{prod(values.shape[1:])}"' if values.ndim > 1 else ""
    return (
        f'<DataArray type="{_TYPES[kind.str[1:]]}" Name={quoteattr(name)}{components} format="binary">'
        f"{b64encode(sizes).decode()}{b64encode(packed).decode()}</DataArray>\n"
    )
