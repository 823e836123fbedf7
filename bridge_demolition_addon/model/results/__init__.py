"""What a run recorded, and what follows from it."""
