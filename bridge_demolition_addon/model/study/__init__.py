"""A study: many runs of one scenario, each with inputs drawn from distributions, and what is asked of them."""
