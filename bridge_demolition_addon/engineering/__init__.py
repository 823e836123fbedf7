"""The engineering: numpy arrays in, numpy arrays out. It knows no file, no scenario and no Blender."""
