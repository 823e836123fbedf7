"""Another run beside the one that is shown."""
