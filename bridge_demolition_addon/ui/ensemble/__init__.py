"""Studies, searches and optimisations during Blender's work: one session, one shape of panel, three kinds."""
