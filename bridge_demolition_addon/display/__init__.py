"""Numbers turned into colours, arrows and film frames."""
