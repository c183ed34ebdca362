"""Natural and damped modes of a gear, and corrections of the model from measurements.

`natural` and `damped` calculate modes; `damped` solves for eigenvalues with `eigen_pairs`, and
refines them with `loss_factors` and `refined` if components have loss factors. `torques` calculates
the torques of all components in a mode. `gear_modes` returns modes by names of links and
components, with their `nodes`; `tables` returns their tables.

`variants` calculates the natural frequencies of many variants of a sweep at once: with
`modal_masses`, with the `secular` equation if a single stiffness varies, and with `other_ratios` if
ratios vary. `crossings` finds the modes whose frequencies can cross; `varied_frequencies` serves
the sweep.

`measured` corrects a case by measured frequencies and decrements, with the formulas of
`decrements`; `decays` derives these numbers from a record.
"""
