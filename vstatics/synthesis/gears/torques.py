"""The torques of engaged elements without losses, for many combinations at once.

In each motion that the mechanisms allow the power of the input goes to the elements and to the
output: ``w_in = sum M_e (w_first - w_second) + M_out w_out`` for all free speeds, by torques over
that of the input. So the rows of speeds that tell a gear's ratio tell its torques, too.
"""

from __future__ import annotations

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.synthesis.gears.kinds import Indices
from vstatics.synthesis.gears.speed_forms import SpeedForms
from vstatics.synthesis.tolerances import DETERMINED, MET_RATIO, NO_TORQUE


@np.errstate(all="ignore")  # what overflows misses its ratio
def element_torques(forms: SpeedForms, members: Indices, ratios: Floats) -> Floats:
    """What the first link of each engaged element gives to it, shape (sets, elements) [-].

    NaN where several elements share what only their sum has, and where so many digits are lost
    that the torque of the output misses the ratio. Of a direct drive by one element the
    torque is ``1/slip`` by its slip while the output stands and nothing is engaged (Voloshko,
    Salakhov and others, (17) to (19)): then no other power is left.

    Parameters
    ----------
    forms : SpeedForms
        As of `engaged_kinds`.
    members : ndarray, shape (sets, elements)
        Sets that have a ratio.
    ratios : ndarray, shape (sets,)
        Theirs. [-]

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.synthesis.gears.speed_forms import FreeSpeeds
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> forms = FreeSpeeds(case).forms([(2, 0), (2, 1), (1, 0), (3, 0), (1, 3)])
    >>> element_torques(forms, np.array([[0], [1]]), np.array([3.5, 1])).round(9)
    array([[-2.5       ],
           [-0.71428571]])
    """
    output = np.full((len(members), 1), len(forms.values) - 2)
    chosen = np.concatenate([members, output], axis=1)
    values = np.nan_to_num(forms.values, posinf=0.0, neginf=0.0)
    rows = values[chosen]
    large = abs(rows).max(axis=2, keepdims=True)
    sizes = np.where(large > 0, large, 1.0)
    inverse = np.linalg.pinv(np.swapaxes(rows / sizes, 1, 2), rcond=DETERMINED)
    torques = inverse @ values[-3] / sizes[..., 0]
    own = np.einsum("sef,sef->se", inverse, rows / sizes)
    torques = np.where(abs(torques) > NO_TORQUE, torques, 0.0)
    met = abs(torques[:, -1] - ratios) <= MET_RATIO * abs(ratios)
    known: Floats = np.where((own > 1 - DETERMINED) & met[:, None], torques, np.nan)
    return known[:, :-1]
