"""The panel of a study: what varies, running it beside Blender's work, and what it came to."""
