"""What pytest leaves out where it looks for examples."""

# A command, whose module is a function.
collect_ignore = ["homebody/cohort.py", "homebody/__main__.py"]
