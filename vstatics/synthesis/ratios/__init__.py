"""Ratios of mechanisms for wanted ratios of gears.

`formula` has the ratio of a gear as a quotient of `multilinear` polynomials, `arrays` calculates
it for many ratios of mechanisms at once. `problem` checks what is asked, within `bounds`; `space`
is what varies. `search` goes from starts all over the bounds to minima, by `least_squares`;
`fitting` does all this, `fitted_case` is the case with what it finds. `estimate` tells of it
before, `grids` after.
"""
