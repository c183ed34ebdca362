"""Fitting of mechanism ratios to wanted gear ratios.

`formula` expresses the ratio of a gear as a quotient of `multilinear` polynomials; `arrays`
evaluates it for many sets of mechanism ratios. `problem` checks the request and its bounds, `space`
contains the variables. `search` starts all over the bounds and finds minima by `least_squares`.
`fitting` combines all steps and builds the case. `tables` present the problem and the result.
"""
