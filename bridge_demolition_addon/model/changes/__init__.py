"""Changes to the structure in one moment: removals, cuts, weakenings, blast zones that fire."""
