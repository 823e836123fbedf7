"""What ``bda`` and ``python -m bridge_demolition_addon`` start: the command line, and what has to be set before it."""

import os
import sys

INTERRUPTED = 130


def main() -> None:
    """Run the command line; Ctrl-C also ends it without a word of Python's while it is being loaded."""
    try:
        _open_closed_streams()
        from .system.signals import interrupted_afterwards  # loaded here, as it may be interrupted too

        with interrupted_afterwards():  # while they load, some libraries take an interrupt for a missing part
            from .cli.main import entry

        entry()
    except KeyboardInterrupt:
        print("bda: interrupted", file=sys.stderr)
        from .cli.console import end_process

        end_process(INTERRUPTED)


def _open_closed_streams() -> None:
    """Send what goes to a closed stream nowhere: the next file that is opened would take its place and get it."""
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        try:
            os.fstat(number)
        except OSError:
            nowhere = os.open(os.devnull, os.O_RDWR)
            if nowhere != number:
                os.dup2(nowhere, number)
                os.close(nowhere)
        if getattr(sys, name) is None:
            setattr(sys, name, os.fdopen(number, "w" if number else "r", encoding="utf-8", closefd=False))


if __name__ == "__main__":
    main()
