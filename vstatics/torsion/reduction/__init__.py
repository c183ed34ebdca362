"""Reduction of a gear to a single link, to a scheme of masses and springs, and to simpler schemes.

`reduced_values` has inertias and compliances reduced to a link. `reduced_scheme` builds the
`scheme` of a gear on its input shaft, and `condensation` removes its masses without inertia.
`simplification` removes partial systems of a `chain` or branched scheme step by step, and `merging`
merges masses that move together. `tables` has the tables.
"""
