"""Annexes that are installed: a test that uses one outside its folder asks here.

`make test-without` removes an annex; in the whole project nothing is skipped. Records of removed
annexes are gone, so commands and public names are listed here, too.
"""

import itertools
import re
from collections.abc import Iterable
from pathlib import Path

import pytest

from vstatics.core.annexes import COMMANDS, annexes

TESTS = Path(__file__).parent
OPTIONS = {
    **dict.fromkeys(("--duty", "--exponent"), "vehicle"),
    **dict.fromkeys(("--gearbox", "--box"), "synthesis"),
}
"""The annex of each option that a command of the core has of it."""
KINDS = {
    **dict.fromkeys(("curves", "histogram", "map"), "sweep"),
    **dict.fromkeys(("campbell", "dump", "modes", "response"), "torsion"),
    "shift": "simulation",
    "boxes": "synthesis",
    **dict.fromkeys(("sawtooth", "spectrum", "steps", "traction"), "vehicle"),
}
"""The annex of each kind of picture that `pictures` does not have itself."""
NAMES = {
    **dict.fromkeys(("Picture", "plot"), "pictures"),
    **dict.fromkeys(("Chunk", "Sweep", "sweep"), "sweep"),
    "ClutchDump": "torsion",
    **dict.fromkeys(("Motion", "Scenario", "VariedScenario", "load_scenario"), "simulation"),
    **dict.fromkeys(("load_varied", "simulate"), "simulation"),
    **dict.fromkeys(("Bearing", "DeviceDamage", "DriveCycle", "Fatigue", "Machine"), "vehicle"),
    **dict.fromkeys(("Performance", "TorqueStrength"), "vehicle"),
    **dict.fromkeys(("RayleighLife", "ResizedShaft", "Trace", "Vehicle", "cycle"), "vehicle"),
    **dict.fromkeys(("damages", "rayleigh_life", "resized", "resized_by_ratio"), "vehicle"),
    "write_report": "page",
}
"""The annex of each public name of the package that is not of the core."""
FILES: dict[str, tuple[str, ...]] = {
    "simulation/published/test_pages.py": ("torsion",),
    "simulation/published/test_published_starts.py": ("torsion",),
    "simulation/report/runs/test_browser.py": ("page",),
    "simulation/report/test_motion.py": ("page",),
    "simulation/report/test_pair.py": ("page",),
    "synthesis/cli/box/test_process.py": ("sweep",),
    "torsion/report/test_vibration.py": ("page",),
    "torsion/vibration/test_varied_frequencies.py": ("sweep",),
}
"""Annexes that files of tests need beside their own, and beside those that it needs."""
ANNEXES = tuple(dict.fromkeys([*COMMANDS.values(), *NAMES.values()]))
HERE = {annex.name for annex in annexes()}
_FOLDER = re.compile(rf"\b(?:vstatics|tests|docs)[./]({'|'.join(ANNEXES)})\b")
_CALL = re.compile(rf"\bvstatics[ .]({'|'.join({**COMMANDS, **NAMES})})\b")
_IMPORT = re.compile(r"^(?:>>> )?from vstatics import (.*)$", re.MULTILINE)
_METHOD = re.compile(r"[\w)]\.plot\(")
_SCENARIO = re.compile(r"\bscenarios/")


def missing(names: Iterable[str]) -> list[str]:
    """Return the annexes of some that are not installed."""
    return sorted({*names} - HERE)


def is_tested(file: Path) -> bool:
    """Return whether the annexes are installed that a file of tests needs."""
    return not missing(FILES.get(file.relative_to(TESTS).as_posix(), ()))


def needs(*names: str) -> pytest.MarkDecorator:
    """Mark a test, or a parameter of one, that runs only where annexes are installed."""
    return pytest.mark.skipif(bool(missing(names)), reason=f"needs {', '.join(missing(names))}")


def skip_without(*names: str) -> None:
    """Skip the rest of a test where annexes are not installed."""
    if absent := missing(names):
        pytest.skip(f"needs {', '.join(absent)}")


def skip_without_command(*words: object) -> None:
    """Skip the rest of a test where the annex of a command, or of its options is missing."""
    command, *others = map(str, words or [""])
    known = [COMMANDS.get(command, ""), *(OPTIONS.get(word, "") for word in others)]
    known += [
        KINDS.get(kind, "")
        for option, kind in itertools.pairwise(others)
        if option in ("-k", "--kind")
    ]
    skip_without(*filter(None, known))


def used_in(text: str) -> set[str]:
    """Return the annexes whose commands, public names or folders a text names.

    >>> sorted(used_in("vstatics simulate run.yaml; vstatics.cycle(case); vstatics.torsion.modes"))
    ['simulation', 'torsion', 'vehicle']
    >>> sorted(used_in("from vstatics import load, sweep\\nfound = results.plot('lever')"))
    ['pictures', 'sweep']
    """
    known = {**NAMES, **COMMANDS, **OPTIONS}
    words = [*_CALL.findall(text), *re.findall(r"\w+", " ".join(_IMPORT.findall(text)))]
    words += ["plot"] * bool(_METHOD.search(text)) + ["simulate"] * bool(_SCENARIO.search(text))
    words += re.findall(r"--[a-z]+", text)
    return {known[word] for word in words if word in known} | {*_FOLDER.findall(text)}
