# SPDX-License-Identifier: GPL-3.0-or-later
"""Install an extension into an empty Blender, switch it off and on, and write down what it brought and left.

Started by test_extension.py, on its own: install_and_remove.py FOLDER_WITH_BPY ZIP MODULE RESULT.json
"""

import importlib
import json
import os
import sys
import types
from pathlib import Path
from typing import Any

BROUGHT = ("bridge_demolition_core", "manifold3d", "matplotlib", "pymap3d", "tqdm", "trimesh")

folder, archive, extension, result = sys.argv[1:]
sys.path.append(folder)

import bpy  # noqa: E402  only to be found in that folder


def traces() -> dict[str, Any]:
    """Everything an add-on can add to Blender that Blender can list."""
    classes = {name: getattr(bpy.types, name, None) for name in dir(bpy.types)}
    handlers = {name: getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)}
    return {
        "handlers": {
            name: [f"{handler.__module__}.{handler.__qualname__}" for handler in functions]
            for name, functions in handlers.items()
            if isinstance(functions, list)
        },
        "classes": sorted(classes),
        "properties": {
            name: sorted(found.bl_rna.properties.keys()) for name, found in classes.items() if hasattr(found, "bl_rna")
        },
        "shortcuts": sum(len(keymap.keymap_items) for keymap in bpy.context.window_manager.keyconfigs.addon.keymaps),
    }


def timers() -> list[str]:
    """Functions of the extension that Blender is still going to call."""
    modules = [module for name, module in sys.modules.items() if name.startswith(extension)]
    functions = [
        value for module in modules for value in vars(module).values() if isinstance(value, types.FunctionType)
    ]
    return [function.__qualname__ for function in functions if bpy.app.timers.is_registered(function)]


def repository() -> int:
    names = [repo.module for repo in bpy.context.preferences.extensions.repos]
    return names.index("user_default")


def is_enabled() -> bool:
    return extension in bpy.context.preferences.addons


bpy.ops.wm.read_factory_settings(use_empty=True)
record: dict[str, Any] = {"before": traces(), "on": [], "off": []}

bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default", enable_on_install=True)
record["enabled"] = is_enabled()
record["packages"] = {name: importlib.import_module(name).__file__ for name in BROUGHT}
importlib.import_module(f"{extension}.engineering.core.library").library()  # fails where the core does not load
for _ in range(2):
    record["on"].append(traces())
    bpy.ops.preferences.addon_disable(module=extension)
    record["off"].append(traces() | {"timers": timers(), "enabled": is_enabled()})
    bpy.ops.preferences.addon_enable(module=extension)
bpy.ops.extensions.package_uninstall(repo_index=repository(), pkg_id=extension.rpartition(".")[2])
record["removed"] = traces() | {"enabled": is_enabled()}

Path(result).write_text(json.dumps(record), encoding="utf-8")
# Whatever the extension left registered must show in the record, not as a crash of Blender's exit.
os._exit(0)
