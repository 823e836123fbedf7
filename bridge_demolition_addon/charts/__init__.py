"""Figures drawn with matplotlib, for logs, reports and windows."""
