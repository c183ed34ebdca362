"""A gear reduced: to one link, to a scheme of masses and springs, to a simpler one.

`reduced_values` has inertias and compliances on one link. `reduced_scheme` is the `scheme` of a
gear on its input shaft, by `condensation` of masses without inertia; a `chain` has partial
systems, by which `simplification` takes masses away, step by step. `tables` has the tables.
"""
