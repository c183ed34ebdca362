"""Pages of HTML: a report of a case, and a served page on which the case can be changed.

`report` writes one page that needs no other files. `serve` serves the same page, with fields and
sliders for the numbers of the case; the page follows changes of the file, and can save its own.
`cli` contains the commands `report` and `serve`.
"""
