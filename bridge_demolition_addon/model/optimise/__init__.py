"""Optimisation: which values of several quantities do best, where what comes out is a matter of chance."""
