"""Ratios of mechanisms for wanted ratios of gears.

`formula` has the ratio of a gear as a quotient of `multilinear` polynomials, `arrays` calculates
it for many ratios of mechanisms at once. `problem` checks what is asked, with its bounds; `space`
is what varies. `search` goes from starts all over the bounds to minima, by `least_squares`;
`fitting` does all this, and makes a case with what is found. `tables` tell of it before and after.
"""
