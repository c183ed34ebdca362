"""HTML pages: a report of a case, and a served page that can change the case.

`report` writes a page that needs no other files. `serve` serves the same page to a browser on this
computer, with fields and sliders for the numbers of the case. The page is updated when the file
changes, and can save changed numbers to the file. `cli` contains the commands `report` and `serve`.
"""
