# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that unpack to far more than they hold, or claim to: refused in words, in little memory and time."""

import gzip
import struct
import zlib

import numpy as np
import pytest
from support.terrain_files import write_las, write_tif

from bridge_demolition_addon.errors import DemolitionError
from bridge_demolition_addon.ifc.settings import ImportSettings
from bridge_demolition_addon.ifc.source import open_source
from bridge_demolition_addon.model.scenario.bodies import Ground
from bridge_demolition_addon.model.terrain.files import read_terrain
from bridge_demolition_addon.model.terrain.landxml import read_landxml
from bridge_demolition_addon.model.terrain.point_files import read_cloud
from bridge_demolition_addon.system.isolated import isolated

ENTITIES = "".join(f'<!ENTITY e{n} "{f"&e{n - 1};" * 10}">' for n in range(1, 12))
LAUGHS = f'<?xml version="1.0"?><!DOCTYPE LandXML [<!ENTITY e0 "lol">{ENTITIES}]><LandXML>&e11;</LandXML>'
QUADRATIC = f'<!DOCTYPE LandXML [<!ENTITY a "{"a" * 100_000}">]><LandXML>{"&a;" * 20_000}</LandXML>'


def refusal_of(read, *args):
    with pytest.raises(DemolitionError) as refusal:
        read(*args)
    said = str(refusal.value)
    assert "Traceback" not in said and "Error:" not in said and len(said) < 400, said
    return said


def tiff_of_one_strip(path, unpacked):
    """The heights of a usual GeoTIFF in a strip that unpacks to as many bytes, all of them 0."""
    write_tif(path)
    content = bytearray(path.read_bytes())
    packer = zlib.compressobj(1)
    strip = b"".join(packer.compress(bytes(10_000_000)) for _ in range(unpacked // 10_000_000)) + packer.flush()
    begin = struct.unpack_from("<I", content, 4)[0]
    for number in range(struct.unpack_from("<H", content, begin)[0]):
        entry = begin + 2 + 12 * number
        tag = struct.unpack_from("<H", content, entry)[0]
        for name, value in ((259, 8), (273, len(content)), (279, len(strip))):
            if tag == name:
                struct.pack_into("<HII", content, entry + 2, 4, 1, value)
    path.write_bytes(bytes(content) + strip)
    return path


@pytest.mark.slow
def test_a_strip_of_a_tiff_that_unpacks_to_half_a_gigabyte(tmp_path):
    path = tiff_of_one_strip(tmp_path / "bomb.tif", 500_000_000)
    assert path.stat().st_size < 3_000_000
    request = {"path": str(path), "kept": str(tmp_path / "kept.npz"), "no_data": None, "scale": 1.0}
    said = refusal_of(isolated, "model.terrain.geotiff", request | {"most_heights": 10**6}, 60.0, 600_000_000)
    assert "unpacks to more than there is memory for" in said


@pytest.mark.parametrize(
    ("place", "form", "value"),
    [(107, "<I", 190_000_000), (100, "<I", 2**32 - 1), (96, "<I", 2**31), (105, "<H", 60_000)],
)
def test_a_point_cloud_that_claims_more_than_it_holds(tmp_path, place, form, value):
    path = write_las(tmp_path / "bomb.las")
    content = bytearray(path.read_bytes())
    struct.pack_into(form, content, place, value)
    path.write_bytes(content)
    assert "claims to hold more than its" in refusal_of(read_cloud, path)


@pytest.mark.parametrize("text", [LAUGHS, QUADRATIC], ids=["entities of entities", "one entity many times"])
def test_entities_of_xml_that_grow(tmp_path, text):
    path = tmp_path / "bomb.xml"
    path.write_text(text)
    assert "cannot be read as LandXML" in refusal_of(read_landxml, path)


@pytest.mark.parametrize("name", ["bomb.ifcxml", "bomb.ifczip", "bomb.ifc"])
@pytest.mark.parametrize("content", [LAUGHS.encode(), gzip.compress(bytes(10_000_000)), b"PK\x03\x04" + bytes(100)])
def test_what_is_no_ifc_as_text_is_not_unpacked(tmp_path, name, content):
    path = tmp_path / name
    path.write_bytes(content)
    said = refusal_of(open_source, path, ImportSettings())
    assert "is no IFC file" in said or "is packed; unpack it" in said or "is XML" in said


def test_a_packed_text_of_heights_is_not_unpacked(tmp_path):
    path = tmp_path / "bomb.asc"
    path.write_bytes(gzip.compress(np.zeros(10_000_000).tobytes()))
    assert "compressed file" in refusal_of(read_terrain, str(path), Ground())
