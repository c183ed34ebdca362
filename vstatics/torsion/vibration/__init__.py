"""Natural modes of a gear, without damping and with it, and what is measured of them.

`natural` and `damped` solve for modes: `damped` by `eigen_pairs`, with `loss_factors` by eigenpairs
that are `refined`. `torques` has the torques of all devices in them. `gear_modes` tells them by
the names of the case, with their `nodes`, in `tables`. `variants` solves for many variants of
a sweep at once: of `modal_masses`, by the `secular` equation where one stiffness varies, with
`other_ratios` where links are joined otherwise; `crossings` tells which frequencies may cross,
`varied_frequencies` are those of a sweep.
`measured` corrects a case by what was measured, with the formulas of `decrements`.
"""
