"""Studies, searches and optimisations beside Blender's work: one session, one shape of panel, three kinds."""
