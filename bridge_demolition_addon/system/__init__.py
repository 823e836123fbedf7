"""Files, locks, archives and signals: what the operating system does for the program."""
