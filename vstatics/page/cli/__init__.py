"""The commands `vstatics report` and `vstatics serve`.

`report` writes the page of one case, of two cases or of found gearboxes. `serve` serves the page
of a case until it is stopped.
"""
