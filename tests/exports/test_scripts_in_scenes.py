# SPDX-License-Identifier: GPL-3.0-or-later
"""A run folder from someone else, whose scene holds Python that Blender runs as it opens the file with its scripts."""

import ast

import pytest
from support.checkout import ROOT
from support.exported_runs import kept_turning_run

from bridge_demolition_addon.cli.main import main

OPENING = {"open_mainfile", "load", "append", "link", "revert_mainfile", "recover_last_session"}


def scene_with_scripts(bpy, path, victim):
    """A .blend with a text that is a module, and a driver; both write a file."""
    writes = f"open({str(victim)!r}, 'a').write('ran')"
    text = bpy.data.texts.new("ran.py")
    text.write(writes)
    text.use_module = True
    driver = bpy.data.objects.new("driven", None).driver_add("location", 0).driver
    driver.expression = f"{writes} or 0"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))


@pytest.mark.slow
def test_no_command_runs_what_a_scene_holds(blender, tmp_path):
    import bpy

    victim, (folder, _) = tmp_path / "ran.txt", kept_turning_run(tmp_path / "run")
    scene_with_scripts(bpy, folder / "scene.blend", victim)
    bpy.ops.wm.open_mainfile(filepath=str(folder / "scene.blend"), use_scripts=True)
    assert victim.read_text().startswith("ran")  # so it would, if it were opened with its scripts
    victim.unlink()
    bpy.ops.wm.read_homefile(use_empty=True)
    assert main(["export", str(folder), "--to", "usd", "--output", str(tmp_path / "run.usdc"), "--quiet"]) == 0
    assert main(["report", str(folder), "--quiet"]) == 0
    assert (tmp_path / "run.usdc").exists() and (folder / "report.html").exists()
    assert not victim.exists()


def test_no_part_of_the_package_opens_a_scene_without_being_asked_by_mouse():
    """Of Blender's ways to open or read a .blend."""
    found = []
    for path in (ROOT / "bridge_demolition_addon").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Attribute) and node.attr in OPENING:
                words = ast.unparse(node)
                if ".wm." in words or "libraries" in words:
                    found.append(f"{path.name}: {words}")
    assert not found
