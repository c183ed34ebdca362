"""Pictures within pages of HTML, and the parts of pages that annexes provide.

`inline` makes an SVG part of a page. `drawn` has a picture of a case as a page has it, or why it
is not drawn. `marks` says what numbers are, for scripts. `parts` has sections and figures, and what
an annex is asked for, and gives, for a section of its own.
"""
