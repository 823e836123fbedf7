"""The report in other languages: a table for each, which a speaker of it can correct, and the look-up of texts."""
