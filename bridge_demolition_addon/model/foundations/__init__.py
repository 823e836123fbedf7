"""Foundations that give: what soil bears under footings, how far they settle, and where they lift off."""
