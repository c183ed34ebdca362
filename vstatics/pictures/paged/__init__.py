"""Pictures within HTML pages, and sections of pages that annexes provide.

`inline` embeds an SVG in a page. `drawn` draws a picture of a case for a page, or gives the reason
why the picture cannot be drawn. `marks` marks numbers so that a script can change them. `parts`
contains sections, figures, and the protocol of a section that an annex provides.
"""
