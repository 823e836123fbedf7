"""Another run next to the one that is shown."""
