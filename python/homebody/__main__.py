"""The command ``homebody``, and ``python -m homebody``."""

import sys

from homebody._homebody import command


def main() -> None:
    """Runs the command with the arguments of the command line, and exits."""
    command(["homebody", *sys.argv[1:]])


if __name__ == "__main__":
    main()
