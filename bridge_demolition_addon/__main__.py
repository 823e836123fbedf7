"""``python -m bridge_demolition_addon``: the same as ``bda``."""

from .cli.main import entry

if __name__ == "__main__":
    entry()
