"""The command ``python -m homebody.cohort``; ``homebody.cohort`` itself is a function."""

import sys

from homebody._cohort import cohort, main

if __name__ == "__main__":
    sys.exit(main())

# Whoever imports the module gets the function, which has its name.
sys.modules[__name__] = cohort  # type: ignore[assignment]
