"""`vstatics synth box --keep`: what is asked of a case, and what can't be."""

import pytest

from tests.commands import vstatics

KEEP = ("--keep", "cases/simpson.yaml", "--ratios", "2.48,1.48,1,-2.09")
COUNTS = ("--sets", 2, "--shift-elements", 4, "--engaged", 2)


@pytest.mark.slow
def test_the_gearbox_itself_is_found() -> None:
    said = vstatics("synth", "box", *KEEP, "-f", "json", "-j", 1)
    listing = said.json
    assert (said.status, listing["searched"], listing["found"]) == (0, 1, 1)


@pytest.mark.parametrize(
    ("given", "status", "told"),
    [
        ((*KEEP, "--sets", 2), 2, "--sets follows from the case of --keep"),
        ((*KEEP, "--free", "sets=1"), 2, "read `sets`, expected shift-elements=N"),
        ((*KEEP, "--free", "elements=x"), 2, "expected a number from 0 to 12"),
        ((*KEEP, "--free", "shift-elements=x"), 2, "expected a number from 0 to 12"),
        (("--free", "elements=1", *COUNTS, *KEEP[2:]), 2, "--free applies to the case of --keep"),
        (("--keep", "cases/none.yaml", *KEEP[2:]), 1, "none.yaml"),
        (("--keep", "cases/two-stage.yaml", *KEEP[2:]), 1, "P0 is not a planetary gear set"),
        (KEEP[2:], 2, "Missing option '--sets'"),
    ],
)
def test_what_can_not_be_asked(given: tuple[object, ...], status: int, told: str) -> None:
    said = vstatics("synth", "box", *given)
    assert said.status == status
    assert told in said.err
