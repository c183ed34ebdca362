"""A case and its results as one page of HTML, which needs nothing from elsewhere.

Results go in; `gather` calculates what the page shows, `page` writes it.

>>> from vstatics import Gear, Mechanism, Transmission, solve
>>> from vstatics.report import gather, page
>>> case = Transmission(2, [], [Mechanism(1, 2, 0, -4.0, 0.98)], [Gear()], name="pair")
>>> page(gather(solve(case))).count("<h1>pair</h1>")
1
"""

from __future__ import annotations

from vstatics.report.gathering import Material, gather
from vstatics.report.page import page

__all__ = ["Material", "gather", "page"]
