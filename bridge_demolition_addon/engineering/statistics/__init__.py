"""What independent runs say about the next one: limits that hold with a confidence, whatever the distribution."""
