"""Natural and damped modes of a gear, and corrections of the model from measurements.

`natural` and `damped` calculate modes; `damped` solves for eigenvalues with `eigen_pairs`, and
refines them with `loss_factors` and `refined` where devices have loss factors. `torques` calculates
the torques of all devices in a mode. `gear_modes` gives modes by the names of the case, with their
`nodes`; `tables` lists them.

`variants` calculates the natural frequencies of many variants of a sweep at once: from
`modal_masses`, from the `secular` equation where a single stiffness varies, and from `other_ratios`
where ratios vary. `crossings` finds the modes whose frequencies can cross; `varied_frequencies`
serves the sweep.

`measured` corrects a case by measured frequencies, with the formulas of `decrements`.
"""
