"""The panel Post Processing: where the logs go."""

import bpy
from bpy.props import BoolProperty, StringProperty

from ...core.errors import OutputError
from ...core.results.files import DEBRIS_LOG, FORCE_LOG
from ...simulation.recording import handlers
from ..operators import Refusing, absolute, refused
from ..sidebar import RELATIVE_PATHS, SidebarPanel

_SUFFIX = ".csv"


class _LogPathOperator(Refusing):
    """Base of the operators that ask for a log's file; each names the setting and the file's usual name."""

    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012  Blender wants a plain set

    filepath: StringProperty(
        name="File", description="CSV file that the log is written to", subtype="FILE_PATH", options=RELATIVE_PATHS
    )
    filter_glob: StringProperty(default="*" + _SUFFIX, options={"HIDDEN"})
    check_existing: BoolProperty(
        name="Check Existing", description="Warn of a file that is there", default=True, options={"HIDDEN"}
    )
    setting: str
    usual_name: str

    @classmethod
    def why_not(cls, _context: bpy.types.Context) -> str | None:
        if handlers.current():
            return "The handler is registered: unregister it before its logs are sent elsewhere"
        return None

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        self.filepath = getattr(context.scene.bda, self.setting) or self.usual_name
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        path = bpy.path.ensure_ext(self.filepath, _SUFFIX) if self.filepath else ""
        try:
            if path and absolute(path).is_dir():
                raise OutputError(f"{path}: expected a file for the log, found a folder")
        except OutputError as error:
            return refused(self, error)
        setattr(context.scene.bda, self.setting, path)
        return {"FINISHED"}


class BDA_OT_set_debris_log(_LogPathOperator, bpy.types.Operator):
    """Choose the file that the debris log is written to; none for the folder of the results"""

    bl_idname = "bda.set_debris_log"
    bl_label = "Set Debris Log Filepath"
    setting = "debris_log_path"
    usual_name = DEBRIS_LOG


class BDA_OT_set_force_log(_LogPathOperator, bpy.types.Operator):
    """Choose the file that the force log is written to; none for the folder of the results"""

    bl_idname = "bda.set_force_log"
    bl_label = "Set Force Log Filepath"
    setting = "force_log_path"
    usual_name = FORCE_LOG


class BDA_PT_post_processing(SidebarPanel, bpy.types.Panel):
    """Where the logs go."""

    bl_label = "Post Processing"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012

    def draw(self, context: bpy.types.Context) -> None:
        settings = context.scene.bda
        for operator in (BDA_OT_set_debris_log, BDA_OT_set_force_log):
            column = self.layout.column(align=True)
            column.enabled = handlers.current() is None
            column.operator(operator.bl_idname)
            column.prop(settings, operator.setting, text="", placeholder="In the folder of the results")


CLASSES = (BDA_OT_set_debris_log, BDA_OT_set_force_log, BDA_PT_post_processing)
