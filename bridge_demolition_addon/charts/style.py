"""What all charts and pages have in common."""

MM_PER_INCH = 25.4

PAGE_WIDTH_MM = 170.0
"""Width between the margins of a page."""
