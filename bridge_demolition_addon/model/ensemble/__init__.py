"""Ensembles: what studies, searches and optimisations have in common, such as the format of their folders."""
