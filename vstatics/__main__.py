"""Run the command line: ``python -m vstatics``."""

from vstatics.core.cli import entry

if __name__ == "__main__":
    entry()
