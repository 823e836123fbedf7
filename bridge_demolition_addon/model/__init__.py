"""What the user writes and what a run recorded: scenarios, studies, results. No Blender."""
