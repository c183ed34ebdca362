"""Reader of the Visual-Statics deck: bytes -> text -> fields -> values -> `Transmission`.

`text` decodes a deck and finds its fields between the prose. `numbers` reads numbers as Fortran's
list-directed input does. `values` reads the values of a field with their places, and `fields` the
number of values that the sizes of the deck require. `table` lists the fields with a value for each
part, and `places` finds the field behind a problem of the model. `reader` builds the transmission.
It remembers the last deck, so that a variant of this deck is read by its changed lines only.
"""
