"""All boxes that there are: sets of shift elements, their gears, ratios of their sets.

`engaged` has the shift elements of a scheme and, as polynomials, the speeds of links in gears;
`ranges` tells which targets a gear can have, `elements` which sets of elements may give all
(`joining` what comes into one next, `matching` which target is whose, `shifts` whether one
element may change at a time), `solving` with which ratios (`set_ratios` nearest to the targets),
all of it compiled and put together in `kernel`; `trying` looks at some of a choice of ports.
"""
