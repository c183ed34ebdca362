"""Fitting of the ratios of mechanisms to wanted ratios of gears.

`formula` expresses the ratio of a gear as a quotient of `multilinear` polynomials; `arrays`
evaluates it for many sets of mechanism ratios. `problem` checks the request and its bounds, and
`space` contains the variables of the fit. `search` starts from points all over the bounds, and
finds minima by `least_squares`. `fitting` combines all steps and builds the case, and `tables`
present the problem and the result.
"""
