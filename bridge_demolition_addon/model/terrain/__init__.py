"""The ground as files have it: heights, made of fewer triangles, levelled under what stands on it."""
