"""Operators that choose the files of the logs."""

import bpy
from bpy.props import StringProperty

from ...errors import OutputError
from ...model.run_folder.files import DEBRIS_LOG, FORCE_LOG
from ..operators import Action, FileWriter, absolute, recording_runs

_SUFFIX = ".csv"


class _LogPathOperator(Action, FileWriter):
    """Base of the operators that ask for a log's file; each names the setting and the file's usual name."""

    bl_options = {"REGISTER", "UNDO"}

    filename_ext = _SUFFIX
    filter_glob: StringProperty(default="*" + _SUFFIX, options={"HIDDEN"})
    setting: str
    usual_name: str

    disabled_reason = staticmethod(recording_runs)

    def usual_path(self, context: bpy.types.Context) -> str:
        return getattr(context.scene.bda, self.setting) or self.usual_name

    def act(self, context: bpy.types.Context) -> str | None:
        path = bpy.path.ensure_ext(self.filepath, _SUFFIX) if self.filepath else ""
        if path and absolute(path).is_dir():
            raise OutputError(f"{path}: expected a file for the log, found a folder")
        setattr(context.scene.bda, self.setting, path)


class BDA_OT_set_debris_log(_LogPathOperator, bpy.types.Operator):
    """Choose the file of the debris log; none for the folder of the results; called Set Debris Log Filepath in 2019"""

    bl_idname = "bda.set_debris_log"
    bl_label = "Choose Debris Log"
    setting = "debris_log_path"
    usual_name = DEBRIS_LOG


class BDA_OT_set_force_log(_LogPathOperator, bpy.types.Operator):
    """Choose the file of the force log; none for the folder of the results; called Set Force Log Filepath in 2019"""

    bl_idname = "bda.set_force_log"
    bl_label = "Choose Force Log"
    setting = "force_log_path"
    usual_name = FORCE_LOG


CLASSES = (BDA_OT_set_debris_log, BDA_OT_set_force_log)
