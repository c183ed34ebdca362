"""What all pictures share: paper, letters, panels with scales, heads, ends, signs.

`style` has colours and sizes, `words` the texts in two languages, `line_styles` how links and
elements look. `labels` measures and places texts, `chart` is a panel with two scales, `ends` names
its lines at the edges, `head` stands above it. `gear_state` is what pictures read of a gear; `svg`
makes the file small and readable.
"""
