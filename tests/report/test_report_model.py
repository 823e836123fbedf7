# SPDX-License-Identifier: GPL-3.0-or-later
"""The run as a model in the page of its report."""

import gzip
import io
import re
from base64 import b64decode

import pytest
import trimesh
from support.exported_runs import turning_run

from bridge_demolition_addon.exports.gltf import animated_glb
from bridge_demolition_addon.report.document.blocks import AnimatedModel, Document
from bridge_demolition_addon.report.document.html import write_html
from bridge_demolition_addon.report.sections import cover
from bridge_demolition_addon.report.sections.cover import model_section


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """The text of a page with nothing but the model."""
    path = tmp_path_factory.mktemp("model") / "page.html"
    write_html(Document("Title", "", (model_section(turning_run()),)), {}, path)
    return path.read_text(encoding="utf-8")


def test_the_model_is_the_one_that_is_exported(page):
    (packed,) = re.findall(r'data-model="([^"]*)"', page)
    content = gzip.decompress(b64decode(packed, validate=True))
    assert content == animated_glb(turning_run())
    scene = trimesh.load_scene(io.BytesIO(content), file_type="glb")
    assert set(turning_run().inventory.body_names) == {mesh for mesh in scene.geometry}


def test_the_page_loads_nothing_and_forbids_it(page):
    (script,) = re.findall(r"<script>(.*?)</script>", page, flags=re.S)
    assert not re.search(r"http|fetch\(|import\b|XMLHttpRequest|WebSocket|sendBeacon|\.src\b", script)
    (allowed,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', page)
    assert allowed.startswith("default-src 'none'; img-src data:;")
    assert not re.search(r"https?:|\*|'self'", allowed)


def test_its_size_is_stated():
    text, shown = model_section(turning_run()).blocks
    assert f"{len(shown.packed) / 1e6:.2g} MB" in text.text


def test_a_model_that_is_too_large_is_left_out_and_that_is_said(monkeypatch):
    monkeypatch.setattr(cover, "MOST_BYTES", 1000)
    (text,) = model_section(turning_run()).blocks
    assert "it is left out" in text.text
    assert "bda export --to gltf" in text.text


def test_the_same_model_gives_the_same_text():
    content = animated_glb(turning_run())
    assert AnimatedModel.of(content, "").packed == AnimatedModel.of(content, "").packed
