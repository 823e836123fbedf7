"""Conclusions from independent runs about the next one: limits with a confidence, whatever the distribution."""
