"""Schemes of planetary sets: which there are, which are one class, how many.

`scheme` is one scheme, by its code; `arrays` has many as rows, adds sets to them and knows which
are sound. `least_codes` has the least code of each class, and the renamings that keep it.
`growth` makes all schemes, set by set, `counts` counts them without that, `estimate` says before
how many, how large and how long; `json_lines` writes them.
"""
