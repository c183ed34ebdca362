"""Tables of random vibration."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vstatics.core.tables.grid import Grid, grid_of
from vstatics.torsion.random.random_vibration import GearRandom

_DEVICES = ("twist [rad]", "rate [rad/s]", "torque [N*m]", "crossings [1/s]", "life [s]")
_LINKS = ("angle [rad]", "velocity [rad/s]", "acceleration [rad/s^2]")


def random_grids(gears: Sequence[GearRandom]) -> Iterator[Grid]:
    """Yield tables of standard deviations, half widths of modes, and spectra."""
    devices = [
        (gear.name, name, *device[:4], "" if device.life is None else device.life)
        for gear in gears
        for name, device in gear.devices.items()
    ]
    yield grid_of("Components: RMS", ["gear", "component", *_DEVICES], devices, key="devices")
    links = [(gear.name, name, *link) for gear in gears for name, link in gear.links.items()]
    yield grid_of("Links: RMS", ["gear", "link", *_LINKS], links, key="links")
    widths = [
        (gear.name, str(mode), width)
        for gear in gears
        for mode, width in enumerate(gear.half_widths, 1)
    ]
    yield grid_of("Modes", ["gear", "mode", "half width [1/s]"], widths, key="modes")
    for gear in gears:
        if gear.spectrum is not None:
            omega, of_input, by_device = gear.spectrum
            title = f"Gear {gear.name}: spectra of twists"
            values = zip(omega, of_input, *by_device.values(), strict=True)
            rows = [tuple(map(float, row)) for row in values]
            yield grid_of(title, ["omega [rad/s]", "input", *by_device], rows, key="spectra")
    faults = [(gear.name, gear.error) for gear in gears if gear.error]
    if faults:
        yield grid_of("Notes", ["gear", "note"], faults, key="notes")
