"""What happens when: removals, weakenings, tools, rest."""
