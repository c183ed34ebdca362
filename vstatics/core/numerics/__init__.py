"""Numerics: singular linear systems, and calculations recorded once and run for many variants.

`elimination.solve` returns the values that equations determine; NaN marks indeterminate values.

>>> from vstatics.core.numerics.elimination import solve
>>> from vstatics.core.numerics.elimination import RIGHT
>>> solve([{0: 1.0, 1: -1.0, RIGHT: 1.0}, {2: 2.0, RIGHT: 10.0}], 3, sums=[{0: 1.0, 1: -1.0}])
Solution(values=[nan, nan, 5.0, 1.0], consistent=True, missing=1, excess=0)

`elimination` solves linear systems; `tolerances` contains the limits below which an entry is zero.
The same code also runs for arrays of variants. While one variant is calculated, `traced` numbers
(of fixed sign) or `signed` numbers (of any sign) record their operations on a `tape`, with a guard
for each decision. `replay` repeats the operations on arrays in `memory`. A plan in `plans` is a
replay with the ranges of its inputs. `exact` converts fractions, `motions` finds the free solutions
of equations, `lookup_table` interpolates over one or two variables, `fixed_points` finds all
efficiencies that agree with their torques, `sides` locates changes of sign, `fronts` selects the
best points for several objectives, `steps` spaces numbers evenly, and `constants` contains physical
constants. No module here depends on transmissions.
"""
