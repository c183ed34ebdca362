"""Search for all gearboxes of a scheme: shift elements, gears and ratios of the gear sets.

A combination consists of the shift elements engaged in a gear, and an element set of all shift
elements of a gearbox. A target is a wanted ratio. `engaged` lists the combinations and calculates
the link speeds with each as polynomials of the gear-set ratios. `ranges` finds the targets that a
combination can reach. `elements` lists the element sets that can reach all targets; `joining`
chooses the element to add next, `matching` assigns gear ratios to targets, and `shifts` checks that
neighbouring gears differ by one element. `solving` finds gear-set ratios that meet all targets, and
`set_ratios` the best of these. `kernel` combines these modules to compiled functions for a choice
of input and output.
"""
