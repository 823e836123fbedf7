"""Runs along one quantity: where to try next, and how the probability of success depends on it."""
