"""Schemes of planetary gear sets: enumeration, classes of equal schemes, and counts.

A scheme states which members of gear sets are one link. `scheme` is a single scheme, given by its
code. `arrays` contains many schemes as rows, adds gear sets to them, and checks that they are sound
(no group of sets always rotates as a block). `least_codes` finds the least code of each class of
equal schemes, and its symmetries. `growth` generates all schemes, set by set, `counts` counts them
without a list, and `estimate` predicts number, size and time; `json_lines` writes them.
"""
