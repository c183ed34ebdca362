"""Pages of HTML: a report of a case, and a served page that follows and changes its file.

`report` writes one page that needs nothing from elsewhere. `serve` serves the same page, with
fields and sliders for the numbers of the case. `cli` has the commands of these names.
"""
