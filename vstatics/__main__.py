"""Run the command line: ``python -m vstatics``."""

from vstatics.cli import main

if __name__ == "__main__":
    main(prog_name="vstatics")
