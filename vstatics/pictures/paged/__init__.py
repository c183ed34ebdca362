"""Pictures within HTML pages, and the parts of pages that annexes provide.

`inline` embeds an SVG in a page. `drawn` draws a picture of a case for a page, or gives the reason
why the picture cannot be drawn. `marks` marks numbers for scripts. `parts` has sections, figures,
and the protocols by which an annex provides a section.
"""
