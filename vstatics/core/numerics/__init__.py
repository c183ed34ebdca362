"""Numbers: linear systems that need not be regular, and one calculation for many variants.

Equations go in, what they determine comes out; NaN stands for what they leave open.

>>> from vstatics.core.numerics.elimination import solve
>>> from vstatics.core.numerics.elimination import RIGHT
>>> solve([{0: 1.0, 1: -1.0, RIGHT: 1.0}, {2: 2.0, RIGHT: 10.0}], 3, sums=[{0: 1.0, 1: -1.0}])
Solution(values=[nan, nan, 5.0, 1.0], consistent=True, missing=1, excess=0)

`elimination` tells which entries are zero (`tolerances`) and solves. The same calculation runs
for arrays: numbers note on a `tape` what is done with them, `traced` ones of one sign, `signed`
ones of any sign, with choices in place of decisions; `replay` does it again on arrays in
`memory`; `plans` makes plans and tells which variant takes which. `exact` has fractions,
`motions` what equations leave free, `lookup_table` values over one or two variables, `fronts`
the best points by several objectives, `compiled` loops by Numba, `constants` those of
physics. Nothing here knows of transmissions.
"""
