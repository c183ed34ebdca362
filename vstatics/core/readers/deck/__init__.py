"""Reader of the deck of Visual-Statics: bytes -> text -> fields -> values -> case.

`text` decodes a deck and finds the fields, which are surrounded by free text (prose). `numbers`
reads numbers as Fortran's list-directed input does. `values` reads the values of a field with their
places, and `fields` the number of values that the sizes of the deck require. `table` lists the
fields with a value for each component, and `places` finds the field that causes a problem of the
case. `reader` builds the case. The last deck is remembered; of a variant of it, only the changed
lines are read.
"""
