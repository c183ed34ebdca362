"""HTML page of a case and its results, which needs no other files.

`material` gathers the contents of the page from the results, `html_page` lays out the page, and
`saving` writes it to a file. `tools` contains the choice of units, the filter by a link and the
buttons for saving. `pair` compares two cases.

>>> from vstatics import Gear, Mechanism, Transmission, solve
>>> from vstatics.page.report.html_page import page
>>> from vstatics.page.report.material import gather
>>> case = Transmission(2, [], [Mechanism(1, 2, 0, -4.0, 0.98)], [Gear()], name="pair")
>>> page(gather(solve(case))).count("<h1>pair</h1>")
1
"""
