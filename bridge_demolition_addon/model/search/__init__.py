"""Searches: where along one quantity an outcome that is a matter of chance turns from failure to success."""
