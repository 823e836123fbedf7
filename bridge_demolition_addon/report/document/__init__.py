"""Blocks of a document, and how they are written as HTML and PDF."""
