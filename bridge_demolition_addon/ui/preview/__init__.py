"""What is about to be built, drawn in the 3D view, and handles there for places that the panels show."""
