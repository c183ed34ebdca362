"""Machine code that is kept is by all files from which it is made."""

import re
from pathlib import Path

import vstatics

PACKAGE = Path(vstatics.__file__).parent


def test_the_key_of_machine_code_is_made_of_all_that_is_compiled() -> None:
    """It holds the files with the words by which `vstatics.numerics.compiled` tells them."""
    for file in PACKAGE.rglob("*.py"):
        text = file.read_text()
        if "@compiled" in text:
            assert "import compiled" in text, file
            for room in re.findall(r"^from vstatics\.(\w+)\.tolerances import", text, re.MULTILINE):
                assert "Tolerances of" in (PACKAGE / room / "tolerances.py").read_text()
