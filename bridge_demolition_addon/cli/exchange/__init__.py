"""Commands for the files of other programs."""
