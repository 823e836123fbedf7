# SPDX-License-Identifier: GPL-3.0-or-later
"""Install the extension from a release by Get Extensions, then update it from the next, and write down what is there.

Started by test_release.py, on its own: install_and_update.py FOLDER_WITH_BPY SERVED FIRST NEXT RESULT.json
FIRST and NEXT are folders of releases, which SERVED holds one after the other.
"""

import json
import os
import shutil
import sys
import tomllib
from pathlib import Path
from typing import Any

folder, served, first, following, result = sys.argv[1:]
sys.path.append(folder)

import bpy  # noqa: E402  only to be found in that folder

PACKAGE = "bridge_demolition_addon"


def serve(release: str) -> None:
    """Put a release in the place of what was served before."""
    shutil.rmtree(served, ignore_errors=True)
    shutil.copytree(release, served)


def state() -> dict[str, Any]:
    """What is installed, and whether it is switched on."""
    repo = bpy.context.preferences.extensions.repos["Releases"]
    manifest = Path(repo.directory, PACKAGE, "blender_manifest.toml")
    module = f"bl_ext.{repo.module}.{PACKAGE}"
    return {
        "version": tomllib.loads(manifest.read_text(encoding="utf-8"))["version"],
        "enabled": module in bpy.context.preferences.addons,
        "runs": sys.modules[f"{module}.version"].VERSION,
    }


bpy.ops.wm.read_factory_settings(use_empty=True)
# Blender installs from a list only where online access is allowed, even from a folder: so nothing else is on its list.
repos = bpy.context.preferences.extensions.repos
for other in [repo for repo in repos if repo.use_remote_url]:
    repos.remove(other)
bpy.context.preferences.system.use_online_access = True
serve(first)
bpy.ops.preferences.extension_repo_add(name="Releases", remote_url=Path(served, "index.json").as_uri(), type="REMOTE")
index = repos.find("Releases")
bpy.ops.extensions.repo_sync(repo_index=index)
bpy.ops.extensions.package_install(repo_index=index, pkg_id=PACKAGE, enable_on_install=True)
record = {"installed": state()}

serve(following)
bpy.ops.extensions.repo_sync(repo_index=index)
bpy.ops.extensions.package_upgrade_all()
record["updated"] = state()

Path(result).write_text(json.dumps(record), encoding="utf-8")
os._exit(0)
