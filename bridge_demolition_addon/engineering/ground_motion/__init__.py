"""Records of ground motion."""
