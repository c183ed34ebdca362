"""A case and its results as one page of HTML that needs nothing from elsewhere.

Results go in. `material` gathers what the page shows, `html_page` writes it, `saving` writes it to
a file. `tools` are the choices of units and links, and the buttons that save; `pair` compares two
cases.

>>> from vstatics import Gear, Mechanism, Transmission, solve
>>> from vstatics.page.report.html_page import page
>>> from vstatics.page.report.material import gather
>>> case = Transmission(2, [], [Mechanism(1, 2, 0, -4.0, 0.98)], [Gear()], name="pair")
>>> page(gather(solve(case))).count("<h1>pair</h1>")
1
"""
