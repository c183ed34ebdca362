"""The picture of efficiency: its shares make up what the efficiency lacks."""

import numpy as np

from tests.pictures.drawn import texts, titled
from tests.pictures.test_pictures import overlaps
from tests.shipped import shipped_results
from vstatics import Gear, Mechanism, Transmission, solve
from vstatics.pictures import picture
from vstatics.pictures.drawing.style import PAGE_HEIGHT, PAGE_WIDTH, Style
from vstatics.pictures.flow.efficiency import draw, loss_shares


def test_shares_of_losses_make_up_what_the_efficiency_lacks() -> None:
    for name in ("umdm.yaml", "zf-8hp70.yaml", "two-stage.yaml", "mzkt7922.dat"):
        for coast in (False, True):
            results = shipped_results(name, coast=coast)
            _, shares = loss_shares(results, Style())
            kept = ~np.isnan(results.efficiency)
            np.testing.assert_allclose(1 - shares.sum(axis=0)[kept], results.efficiency[kept])
            assert (shares[:, kept] >= -1e-12).all()


def test_a_part_of_the_loss_has_its_name_and_says_what_it_takes() -> None:
    """Two pairs one after the other: .96 * .75, so .04 and .24 of the power that enters."""
    pairs = [Mechanism(1, 2, 0, -2.5, 0.96), Mechanism(2, 3, 0, -1.5, 0.75)]
    case = Transmission(3, [], pairs, [Gear()], output=3)
    figure = picture(solve(case), "efficiency", Style())
    parts = ["gear 1, D1: 4 %", "gear 1, D2: 24 %"]
    assert [said for said, _ in titled(figure) if said] == [*parts, "gear 1: efficiency 0.720"]
    assert texts(figure).count("D2") == 2  # in the part and in the key
    assert "0.720" in texts(figure)
    colours = {one.get_facecolor() for said, one in titled(figure) if said in parts}
    assert len(colours) == 2


def test_many_gears_stand_in_panels_below_one_another_on_pages_of_paper() -> None:
    """Forty gears: each name and number once, numbers 30 pt apart at least."""
    pairs = [Mechanism(1, 2, 0, ratio=2.0, efficiency=0.96)]
    gears = [Gear(name=f"g{number}") for number in range(40)]
    results = solve(Transmission(2, [], pairs, gears))
    paper = Style(height=PAGE_HEIGHT)
    pages = [*draw(results, paper)]
    said = [text for page in pages for text in texts(page)]
    assert [said.count(gear.name) for gear in gears] == [1] * 40
    assert said.count("0.960") >= 40
    for page in pages:
        wide, high = page.size
        assert wide <= PAGE_WIDTH + 1e-6
        assert high <= PAGE_HEIGHT + 1e-6
    assert overlaps(results, "efficiency", Style()) == []
