# SPDX-License-Identifier: GPL-3.0-or-later
"""Bridge Demolition Add-on: plan the demolition of a bridge with Blender's rigid bodies."""


def register() -> None:
    """Called by Blender when the extension is switched on."""
    for module in _interface():
        module.register()


def unregister() -> None:
    """Called by Blender when the extension is switched off: takes back all that `register` and the buttons did."""
    for module in reversed(_interface()):
        module.unregister()


def _interface() -> tuple:
    # The engineering in `core` and the checks of the command line work where there is no Blender to import.
    from .simulation import blender_events
    from .ui import registration, scene_settings
    from .ui.contours import decorator, view
    from .ui.ground import decorator as ground_decorator
    from .ui.preview import decorator as preview_decorator
    from .ui.study import decorator as study_decorator

    drawings = (decorator, ground_decorator, study_decorator, preview_decorator)
    return (blender_events, scene_settings, view, registration, *drawings)
