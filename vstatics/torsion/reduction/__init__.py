"""Reduction of a gear to a single link, to a scheme of masses and springs, and to simpler schemes.

`reduced_values` reduces inertias and compliances to a link. `reduced_scheme` builds the `scheme` of
a gear on its input shaft, and `condensation` removes its masses without inertia. `simplification`
removes partial systems of a `chain` or branched scheme step by step, and `merging` merges masses
that move together. `tables` returns the tables.
"""
