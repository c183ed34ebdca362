"""The search for boxes piece by piece, and what it will take.

`ports` searches one scheme with any of its ports, with the `arrays` that the compiled search
takes. `cut` tells which part of which schemes a piece is, `found` what is in it, and `work` is
what workers do and what is finished and kept. Some ports are `tried` before, for the size of the
pieces and for the `estimate`.
"""
