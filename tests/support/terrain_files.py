# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of terrain that tests write, in every format that is read, of one and the same ground."""

import numpy as np

EASTING, NORTHING, HEIGHT = 448_200.0, 4_607_100.0, 250.0
"""Where the file's first height is: a place on a map in metres, far from 0."""


def plane(x, y):
    """Height of ground that rises to the east by 1 in 5 and to the north by 1 in 20."""
    return HEIGHT + 0.2 * (x - EASTING) + 0.05 * (y - NORTHING)


def lattice(count=41, step=2.5):
    """Eastings and northings (r, c) of a square grid, rows from south to north."""
    numbers = step * np.arange(count)
    return np.meshgrid(EASTING + numbers, NORTHING + numbers)


def write_asc(path, height=plane, *, count=41, step=2.5, header=(), no_data=-9999.0):
    x, y = lattice(count, step)
    lines = {
        "ncols": count,
        "nrows": count,
        "xllcenter": EASTING,
        "yllcenter": NORTHING,
        "cellsize": step,
        "NODATA_value": no_data,
    } | dict(header)
    rows = np.where(np.isnan(height(x, y)), no_data, height(x, y))[::-1]
    head = "".join(f"{name} {value}\n" for name, value in lines.items() if value is not None)
    path.write_text(head + "\n".join(" ".join(map(repr, row.tolist())) for row in rows) + "\n", encoding="utf-8")
    return path


def write_xyz(path, height=plane, *, separator=" ", header="", scattered=False):
    x, y = (grid.ravel() for grid in lattice())
    if scattered:
        # Off the grid by up to a third of its step, the border but for: every place is still between points.
        inside = (x > x.min()) & (x < x.max()) & (y > y.min()) & (y < y.max())
        shift = np.random.default_rng(7).uniform(-0.8, 0.8, (2, len(x))) * inside
        x, y = x + shift[0], y + shift[1]
    rows = np.column_stack((x, y, height(x, y)))
    text = "\n".join(separator.join(map(repr, row)) for row in rows.tolist())
    path.write_text(header + text + "\n", encoding="utf-8")
    return path


def triangles(count=41):
    """Triangles (t, 3) between the nodes of a lattice, row by row."""
    first = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    squares = np.column_stack((first, first + 1, first + count + 1, first + count))
    return np.concatenate((squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]))


def write_landxml(path, height=plane, unit='<Metric linearUnit="meter"/>', surfaces=1):
    x, y = (grid.ravel() for grid in lattice())
    points = "".join(
        f'<P id="{row + 1}">{north!r} {east!r} {z!r}</P>'
        for row, (east, north, z) in enumerate(np.column_stack((x, y, height(x, y))).tolist())
    )
    faces = "".join(f"<F>{a} {b} {c}</F>" for a, b, c in (triangles() + 1).tolist())
    inner = f'<Definition surfType="TIN"><Pnts>{points}</Pnts><Faces>{faces}</Faces></Definition>'
    body = "".join(f'<Surface name="ground {number + 1}">{inner}</Surface>' for number in range(surfaces))
    path.write_text(
        f'<?xml version="1.0"?><LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2" version="1.2">'
        f"<Units>{unit}</Units><Surfaces>{body}</Surfaces></LandXML>",
        encoding="utf-8",
    )
    return path


def write_obj(path, height=plane):
    """Write a mesh about its own origin, as meshes in single precision have to be."""
    x, y = (grid.ravel() for grid in lattice())
    corners = np.column_stack((x - EASTING, y - NORTHING, height(x, y) - HEIGHT))
    lines = [f"v {a!r} {b!r} {c!r}" for a, b, c in corners.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (triangles() + 1).tolist()]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def write_mesh(path, height=plane):
    """The lattice as a mesh of the kind that the name ends in."""
    import trimesh

    x, y = (grid.ravel() for grid in lattice())
    mesh = trimesh.Trimesh(np.column_stack((x, y, height(x, y))), triangles(), process=False)
    mesh.export(path)
    return path


def write_tif(path, height=plane, *, kind="float32", keys=(), no_data=None, tags=None, values=None):
    """Write a GeoTIFF; its keys are those of a projected map in metres unless others are given."""
    import tifffile

    x, y = lattice()
    heights = height(x, y)[::-1] if values is None else values
    if no_data is not None:
        heights = np.where(np.isnan(heights), no_data, heights)
    # Key, place, count and value: projected, pixels are areas, UTM zone 15 north, metres.
    pairs = {1024: 1, 1025: 1, 3072: 26915, 3076: 9001} | dict(keys)
    directory = [1, 1, 0, len(pairs)]
    for code, value in sorted(pairs.items()):
        directory += [code, 0, 1, value]
    # The north-western corner, half a step off the middle of the first pixel.
    tie = (0.0, 0.0, 0.0, EASTING - 1.25, float(y.max()) + 1.25, 0.0)
    extra = [(33550, "d", 3, (2.5, 2.5, 0.0)), (33922, "d", 6, tie), (34735, "H", len(directory), tuple(directory))]
    if no_data is not None:
        extra.append((42113, "s", 0, str(no_data)))
    extra = extra if tags is None else tags
    tifffile.imwrite(path, heights.astype(kind), extratags=[(*tag, True) for tag in extra], metadata=None)
    return path


def write_las(path, height=plane):
    """Write a cloud of points in LAS, or in LAZ by the ending of the path, all of the class of ground."""
    import laspy

    x, y = (grid.ravel() for grid in lattice())
    cloud = laspy.LasData(laspy.LasHeader(point_format=1, version="1.2"))
    cloud.header.offsets, cloud.header.scales = (EASTING, NORTHING, HEIGHT), (0.001, 0.001, 0.001)
    cloud.x, cloud.y, cloud.z = x, y, height(x, y)
    cloud.classification = np.full(len(x), 2, dtype=np.uint8)
    cloud.write(path)
    return path
