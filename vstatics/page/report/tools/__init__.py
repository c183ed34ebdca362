"""Tools of a page with marked numbers: units, filter by a link, saving.

`marks` adds the links of each row and the unit of each number to tables. `toolbar` contains the
input fields, and the data for their script. The script has four files: `numbers.js` rounds numbers,
`units.js` converts them, `links.js` filters rows, and `saves.js` saves pictures, tables and
results.
"""
