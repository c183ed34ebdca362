"""Reader of the Visual-Statics deck: bytes -> text -> fields -> values -> `Transmission`.

`text` decodes a deck and finds its fields in the surrounding prose. `numbers` reads numbers like
Fortran's list-directed input. `values` reads the values of a field with their places, and `fields`
reads lists of the lengths that the deck prescribes. `table` declares the lists with a value for
each part, and `places` finds the field that causes a problem of the model. `reader` builds the
transmission. It stores the last deck, so that only changed lines of a variant are read.
"""
