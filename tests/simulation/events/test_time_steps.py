"""Explicit time steps against DOP853 of scipy, which has the same coefficients and step control."""

import numpy as np
import pytest
from scipy.integrate import DOP853

from tests.simulation.test_closed_forms import links
from vstatics.simulation import Formula, Scenario, Start
from vstatics.simulation.events.selection import ModesAsked
from vstatics.simulation.events.time_steps import StepTolerances, steps
from vstatics.simulation.run import begun

END = 2.0


@pytest.mark.parametrize("first", [None, 1.0])  # the second is rejected at first
def test_steps_and_states_within_them_agree_with_scipy(first: float | None) -> None:
    loads = (
        (1, Formula("30*sin(3*t)*exp(-speed/10)")),
        (2, Formula("20*cos(t) - 5*tanh(speed/0.2)")),
    )
    scenario = Scenario(links(2.0, 3.0), END, Start(speeds={1: 5.0, 2: 0.5}), {}, loads)
    run = begun(scenario, step=None, rtol=1e-8)
    selected = run.selection.select(ModesAsked(run.at, None, run.scales))
    tolerances = StepTolerances(1e-9, np.full(len(selected.state), 1e-9))
    begin = 0.0, selected.state
    solver = DOP853(
        selected.equations.derivative, *begin, END, rtol=1e-9, atol=1e-9, first_step=first
    )
    number = 0
    for step in steps(selected.equations, begin, END, tolerances, first):
        solver.step()
        assert step.end == pytest.approx(solver.t, rel=1e-7)
        between = solver.dense_output()(step.times)
        assert step.states == pytest.approx(between, rel=1e-7, abs=1e-8)
        inner = step.start + np.array([0.2, 0.7]) * (step.end - step.start)
        assert step.between(inner) == pytest.approx(
            solver.dense_output()(inner), rel=1e-7, abs=1e-8
        )
        assert step.exact(step.end) == pytest.approx(step.last, rel=1e-7, abs=1e-8)
        number += 1
    assert solver.status == "finished"
    assert number > 5
