"""Whether the button Run is at work, which plays the timeline itself and is stopped by Esc alone."""

import bpy

_timers: list[bpy.types.Timer] = []
"""That of the run, if one goes on: switching the extension off takes its operator away without a word to it."""


def begin(context: bpy.types.Context, tick_s: float, frames: int) -> None:
    """Have Blender call the operator again and again, and show its progress."""
    manager = context.window_manager
    manager.progress_begin(0, frames)
    _timers.append(manager.event_timer_add(tick_s, window=context.window))


def end(context: bpy.types.Context) -> None:
    """Take back what a run shows, if there is one."""
    if not _timers:
        return
    context.window_manager.event_timer_remove(_timers.pop())
    context.window_manager.progress_end()
    if context.workspace:
        context.workspace.status_text_set(None)


def goes_on() -> bool:
    """Whether a run is at work."""
    return bool(_timers)
