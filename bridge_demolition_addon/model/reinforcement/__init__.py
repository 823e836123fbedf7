"""Bars of a bridge by a rule: designed for its own weight and traffic, or by ratios of steel."""
