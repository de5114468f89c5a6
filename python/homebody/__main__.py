"""The command ``homebody``, and ``python -m homebody``."""

import sys

from homebody._homebody import command


def main() -> None:
    """Does what the words of the command line ask for, and ends the program."""
    command(["homebody", *sys.argv[1:]])


if __name__ == "__main__":
    main()
