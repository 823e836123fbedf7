"""Texts of one kind of action each, in all languages: texts of reports and of the window, by the English text."""
