"""Sub-steps, frames and slow motion."""
