"""Pictures of several gears on a page."""

import re

from tests.shipped import shipped_results
from vstatics.pictures.paged.drawn import of_each

ROW = re.compile(r'transform="translate[(]([\d.]+) ([\d.]+)[)]"><g id="(row-[^"]*)" ')


def test_a_sheet_of_all_gears_uses_the_rows_of_each_gear() -> None:
    results = shipped_results("ravigneaux-gf4a.yaml")
    numbers = range(1, len(results.case.gears) + 1)
    *singles, sheet = of_each(results, "flow", [*([number] for number in numbers), []])
    defined = [name for single in singles for *_, name in ROW.findall(single.sheets[0])]
    used = re.findall('<use href="#([^"]*)"', sheet.sheets[0])
    assert used
    assert {*used} <= {*defined}
    assert len({*defined}) == len(defined) == len(numbers)
