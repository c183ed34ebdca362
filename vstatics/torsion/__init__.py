"""The same case as a torsional system: natural modes, reduction, simplification, response.

A gear is a `TorsionalSystem` of bodies, of elastic and of rigid devices, each with the row that
it has in the structural-distribution matrix (`system`). `coordinates` splits its motions into
free, massless and rigid ones; `natural` and `damped` solve for the modes, `torques` for the
torques of all devices; `gear_modes` tells them by name. The room needs scipy, an extra.

Source: Tsitovich, Algin, Vehicle dynamics, Minsk, 1981 (chapters 1 to 3, appendices 1 to 3).
"""
