"""The Visual-Statics deck: bytes -> text -> fields -> values -> Transmission.

`text` tries the encodings in which a deck may be written, and finds where its fields stand
between the prose. `numbers` takes numbers as Fortran's list-directed input does, `values` as
many of them as a field needs, each with its place; `fields` knows from the sizes of the deck
how many these are, `table` which lists have a value for each part, and `places` which field
gives a part of the model. `reader` makes the
transmission of it all, and remembers the last deck: of a variant of that it reads only the
lines that differ.
"""
