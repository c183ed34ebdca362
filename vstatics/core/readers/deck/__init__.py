"""Reader of the Visual-Statics deck: bytes -> text -> fields -> values -> `Transmission`.

`text` decodes a deck and finds its fields in the surrounding prose. `numbers` reads numbers like
Fortran's list-directed input. `values` reads the values of a field with their places, and `fields`
reads lists of the lengths that the deck prescribes. `table` lists the fields with a value for each
part, and `places` finds the field that causes a problem of the model. `reader` builds the
transmission. It stores the last deck, so that for a variant of this deck only the changed lines are
read.
"""
