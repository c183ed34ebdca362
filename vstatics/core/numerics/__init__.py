"""Numerics: linear systems that can be singular, and one calculation run for many variants.

`elimination.solve` returns the values that equations determine; NaN marks indeterminate values.

>>> from vstatics.core.numerics.elimination import solve
>>> from vstatics.core.numerics.elimination import RIGHT
>>> solve([{0: 1.0, 1: -1.0, RIGHT: 1.0}, {2: 2.0, RIGHT: 10.0}], 3, sums=[{0: 1.0, 1: -1.0}])
Solution(values=[nan, nan, 5.0, 1.0], consistent=True, missing=1, excess=0)

`elimination` decides which entries are zero (`tolerances`) and solves. The same calculation runs
for arrays: numbers record their operations on a `tape`, as `traced` numbers of fixed sign or as
`signed` numbers of any sign, with choices instead of decisions. `replay` repeats the operations on
arrays in `memory`, and `plans` makes plans and assigns variants to them. `exact` converts
fractions, `motions` finds the free solutions of equations, `lookup_table` interpolates over one or
two variables, `sides` locates changes of sign, `fronts` selects the best points by several
objectives, `steps` spaces numbers evenly, `compiled` compiles loops with Numba, and `constants` are
those of physics. Nothing here knows of transmissions.
"""
