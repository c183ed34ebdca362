"""Find all gearboxes of a scheme: sets of shift elements, their gears, ratios of the gear sets.

`engaged` lists the shift elements of a scheme and calculates the link speeds in each gear as
polynomials of the ratios. `ranges` finds the targets that a gear can reach. `elements` lists the
sets of shift elements that can provide all gears; `joining` chooses the element to add next,
`matching` assigns gears to targets, and `shifts` checks for single shifts. `solving` finds the
ratios of the gear sets (`set_ratios`: nearest to the targets). All of it is compiled and combined
in `kernel`, for all boxes of a choice of ports or for a sample.
"""
