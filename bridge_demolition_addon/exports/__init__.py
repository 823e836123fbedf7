"""A run in the files of other programs: ParaView, spreadsheets, browsers, and those that make films."""
