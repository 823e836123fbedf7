"""Materials and reinforcement as the user gives them."""
