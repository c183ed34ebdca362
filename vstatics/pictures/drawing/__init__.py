"""What all pictures share: paper, letters, panels with scales, heads, ends, signs.

`style` has colours, sizes and lengths, `words` the texts in two languages, `line_styles` how links
and elements look, `tolerances` what is too small to be seen. `labels` measures and places texts,
`pen` draws all of them, lines, areas and the scales of panels; `ends` names lines at the edges of
panels, `head` stands above them. `gear_state` is what pictures read of a gear; `groups` puts
together what has one key; `free` finds places for texts within a panel; `svg` makes the file small
and readable; `join` puts pictures of two cases on one sheet.
"""
