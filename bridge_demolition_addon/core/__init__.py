"""The engineering: numpy arrays in, numpy arrays out. Never imports bpy."""
