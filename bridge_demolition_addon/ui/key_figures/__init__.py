"""Key figures, a history of force and the debris of the shown frame, over the 3D view."""
