"""The report in units other than SI: quantities are read where they stand in texts, tables and drawings."""
