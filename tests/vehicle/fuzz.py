"""Good inputs of readers of duties, for `tests.fuzz`."""

from tests.fuzz import Kind
from vstatics.vehicle.duty_file import read_duty

KINDS = {
    "duty": Kind(
        ("energy: {1: .2, 2: .3, 3: .5}\n", "time: {low: 1/3, R: 2/3}\n"),
        lambda data: read_duty(data, "duty.yaml"),
    )
}
