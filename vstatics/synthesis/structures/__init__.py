"""Schemes of planetary gear sets: enumeration, classes of equal schemes, and counts.

`scheme` is a single scheme, given by its code. `arrays` contains many schemes as rows, adds sets to
them and checks soundness. `least_codes` finds the least code of each class, and the renamings that
keep it. `growth` generates all schemes, set by set, `counts` counts them without a list, and
`estimate` predicts number, size and time; `json_lines` writes them.
"""
