"""Explanation of a gear: matrix, equations with their solution, and the formula of the ratio.

`explain_gear` returns the explanation of a gear as data. `text` and `answer` write the data.

>>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
>>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
>>> gear = explain_gear(solve(case), 1)
>>> gear.formula.text, gear.ratio, gear.speeds.values
('1 - u_D1', 3.5, {'w_1': 1.0, 'w_2': 0.0, 'w_3': 0.2857142857142857})
>>> gear.speeds.equations[0].terms[1]
Term(unknown='w_2', symbol='-u_D1', coefficient=2.5)
"""

from vstatics.core.explain.explanation import Explanation, explain_gear

__all__ = ["Explanation", "explain_gear"]
