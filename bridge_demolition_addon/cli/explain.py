"""``bda explain``: print what the reference says of a key."""

import argparse

from ..model.ensemble.reference import explanation


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "explain",
        description="Print the reference of a key or of a table, as docs/scenario.md and the other references have it.",
        allow_abbrev=False,
    )
    parser.add_argument("key", metavar="KEY", help="such as ball.mass_kg, mass_kg, ball or charges")
    parser.set_defaults(execute=explain)


def explain(arguments: argparse.Namespace) -> None:
    """Print the reference of a key."""
    for line in explanation(arguments.key):
        print(line)
