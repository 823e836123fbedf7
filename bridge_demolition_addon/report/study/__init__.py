"""The report of a study: what many runs say of the next one."""
