"""What a reader does with a page whose numbers have marks: choose units and a link, save.

`marks` tells which rows are of which links, and which numbers are in which unit; `toolbar` has
the fields and what their script has to know. The script is in four files: `numbers.js` rounds,
`units.js`, `links.js` and `saves.js` do what their names say.
"""
