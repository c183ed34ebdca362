"""Random vibration: closed forms, and quadrature over a transfer function made here."""

import math
from itertools import pairwise
from random import Random

import numpy as np
import pytest
from scipy.integrate import quad, quad_vec

from tests.chance import count, each_seed, seeded
from tests.installed import needs
from tests.torsion.systems import Array, chain, matrices, mounted, sprung
from vstatics import Damping, Gear, Load, Mechanism, Spring, Transmission
from vstatics.core.model.converters import Converter
from vstatics.torsion import modes, random_vibration
from vstatics.torsion.random.spectra import Correlation, Spectrum, SpectrumPoints, White

IN_BAND = SpectrumPoints(((2.0, 0.5), (9.0, 2.0), (30.0, 0.1), (60.0, 0.0)))


def mass(damping: Damping | float = 3.0) -> Transmission:
    """A mass of 2 kg*m^2 on 200 N*m/rad."""
    return mounted(damping, 200.0, 2.0)


def test_white_torque_on_one_mass() -> None:
    """D = pi S/(k c), D' = pi S/(k J), crossings sqrt(c/J)/2 pi; the acceleration has none."""
    [gear] = random_vibration(mass(), 1, White(2.5))
    one, link = gear.devices["mount"], gear.links["1"]
    assert one.twist_rms**2 == pytest.approx(math.pi * 2.5 / (3 * 200), rel=1e-12)
    assert one.twist_rate_rms**2 == pytest.approx(math.pi * 2.5 / (3 * 2), rel=1e-12)
    assert one.torque_rms == pytest.approx(math.hypot(200 * one.twist_rms, 3 * one.twist_rate_rms))
    assert one.crossings == pytest.approx(math.sqrt(200 / 2) / (2 * math.pi))
    assert (link.rms, link.velocity_rms) == pytest.approx((one.twist_rms, one.twist_rate_rms))
    assert math.isnan(link.acceleration_rms)
    assert gear.half_widths == pytest.approx([3 / (2 * 2)])


def test_the_spectrum_of_a_twist_is_that_of_the_torque_by_the_square_of_the_answer() -> None:
    """S/((c - J w^2)^2 + (d w)^2), at, below and above the resonance of 10 rad/s."""
    omegas = np.array([0.0, 3.0, 10.0, 25.0])
    [gear] = random_vibration(mass(), 1, White(2.5), omegas=omegas)
    assert gear.spectrum is not None
    assert gear.spectrum.input.tolist() == [2.5] * 4
    expected = 2.5 / ((200 - 2 * omegas**2) ** 2 + (3 * omegas) ** 2)
    np.testing.assert_allclose(gear.spectrum.devices["mount"], expected, rtol=1e-12)


@pytest.mark.parametrize("ratio", [2.0, -0.4])
def test_a_link_that_is_moved_through_a_pair_moves_by_the_ratio(ratio: float) -> None:
    """A mass on a spring at the second link, which turns by 1/u: closed form of IN_BAND/u^2."""
    shaft = Spring({2: 1, 3: -1}, stiffness=200.0, damping=3.0, name="shaft")
    pair = Mechanism(1, 2, 0, ratio)
    case = Transmission(3, [], [pair], [], springs=[shaft], inertias={3: 2.0}, output=3)
    [gear] = random_vibration(case, 1, IN_BAND, by="motion")
    corners = [point[0] for point in IN_BAND.points]

    def of_mass(w: float) -> float:
        passed = 200**2 + (3 * w) ** 2
        spectrum = float(np.interp(w, corners, [point[1] for point in IN_BAND.points]))
        return 2 * spectrum * passed / ((200 - 2 * w * w) ** 2 + (3 * w) ** 2)

    exact = sum(quad(of_mass, *ends, epsrel=1e-11)[0] for ends in pairwise(corners))
    assert gear.links["3"].rms ** 2 == pytest.approx(exact / ratio**2, rel=1e-8)


def test_without_damping_there_are_values_away_from_the_resonance_alone() -> None:
    [nothing] = random_vibration(mass(0.0), 1, White(1.0))
    assert np.isnan([*nothing.devices["mount"][:4], *nothing.links["1"]]).all()
    assert nothing.half_widths == [0.0]
    [hit] = random_vibration(mass(0.0), 1, IN_BAND)
    assert math.isnan(hit.devices["mount"].twist_rms)
    above = SpectrumPoints(((12.0, 3.0), (20.0, 3.0)))
    [some] = random_vibration(mass(0.0), 1, above)
    exact, _ = quad(lambda w: 6 / (200 - 2 * w * w) ** 2, 12, 20, epsabs=0, epsrel=1e-12)
    assert some.devices["mount"].twist_rms ** 2 == pytest.approx(exact, rel=1e-10)


def made(random: Random, lossy: bool) -> Transmission:
    """A chain that is held at its end, all dampings above 0; perhaps a massless link in it."""
    links = random.randint(2, 4)
    springs = []
    for n in range(1, links + 1):
        viscous, loss = random.uniform(0.4, 1.5), random.choice([0.0, 0.2]) * lossy
        damping = Damping(viscous=viscous, loss_factor=loss)
        twist = {n: 1, n + 1: -1} if n < links else {n: 1}
        springs.append(Spring(twist, 10 ** random.uniform(1, 2.5), damping=damping, name=f"c{n}"))
    inertias = {n: 10 ** random.uniform(-1, 0.5) for n in range(1, links + 1)}
    if links > 2 and random.random() < 0.4:
        del inertias[2]
    return sprung(links, springs, inertias)


def answers(case: Transmission, at: int, by_motion: bool, omegas: Array) -> Array:
    """Angles of links by the dynamic stiffness of the definition, shape (omegas, links)."""
    mass, stiffness, resistance = matrices(case)
    for one in case.springs:
        row = np.array([one.form.get(n, 0.0) for n in range(1, case.links + 1)])
        assert isinstance(one.damping, Damping)
        stiffness = stiffness + 1j * one.damping.loss_factor * one.rate * np.outer(row, row)
    w = omegas[:, None, None]
    dynamic = stiffness + 1j * w * resistance - w**2 * mass
    if not by_motion:
        force = np.broadcast_to(np.eye(case.links)[:, [at]], (len(omegas), case.links, 1))
        return np.linalg.solve(dynamic, force)[:, :, 0]
    others = [n for n in range(case.links) if n != at]
    moved = np.zeros((len(omegas), case.links), complex)
    moved[:, at] = 1.0
    held = dynamic[:, others][:, :, others]
    moved[:, others] = -np.linalg.solve(held, dynamic[:, others][:, :, [at]])[:, :, 0]
    return moved


def by_quadrature(
    case: Transmission, at: int, by_motion: bool, spectrum: Spectrum, order: float
) -> Array:
    """2 int S |w^order H|^2 of every twist, by Gauss's rule in many pieces of log w."""
    links = range(1, case.links + 1)
    twists = np.array([[one.form.get(n, 0.0) for n in links] for one in case.springs])
    in_band = isinstance(spectrum, SpectrumPoints)
    edges = [2.0, 9.0, 30.0, 60.0] if in_band else [1e-6, 1e-2, 1e5, 1e9]
    nodes, weights = np.polynomial.legendre.leggauss(16)
    total = np.zeros(len(twists))
    for a, b in pairwise(edges):
        cuts = np.linspace(math.log(a), math.log(b), 400)
        half = np.diff(cuts)[:, None] / 2
        omegas = np.exp(cuts[:-1, None] + half + half * nodes).ravel()
        squares = np.abs(answers(case, at, by_motion, omegas) @ twists.T) ** 2
        sizes = 2 * spectrum.at(omegas) * omegas ** (2 * order + 1) * (half * weights).ravel()
        total += sizes @ squares
    return total


@pytest.mark.parametrize("lossy", [pytest.param(False, marks=pytest.mark.slow), True])
@pytest.mark.parametrize("spectrum", [White(0.7), Correlation(2.0, ((1.0, 3.0, 8.0),)), IN_BAND])
def test_random_systems_by_quadrature(spectrum: Spectrum, lossy: bool) -> None:
    """Where there is a variance; loss factors as a part of the elastic torque at any frequency."""
    random = seeded(5)
    for _ in range(count(3, 40)):
        case = made(random, lossy)
        heavy = [n for n in range(case.links) if n + 1 in case.inertias]
        by_motion = isinstance(spectrum, SpectrumPoints) and random.random() < 0.5
        at = random.choice(heavy)
        by = "motion" if by_motion else "torque"
        [gear] = random_vibration(case, at + 1, spectrum, by=by)  # type: ignore[arg-type]
        devices = [gear.devices[one.name] for one in case.springs]
        twist = by_quadrature(case, at, by_motion, spectrum, 0)
        assert [one.twist_rms**2 for one in devices] == pytest.approx(twist.tolist(), rel=1e-6)
        rate = by_quadrature(case, at, by_motion, spectrum, 1)
        known = [n for n, one in enumerate(devices) if not math.isnan(one.twist_rate_rms)]
        found = [devices[n].twist_rate_rms ** 2 for n in known]
        assert found == pytest.approx(rate[known].tolist(), rel=1e-5)
        assert len(known) == len(devices) or 2 not in case.inertias
        half = by_quadrature(case, at, by_motion, spectrum, 0.5)
        for n in known:  # |k + i k loss + i c omega|^2 of the twist
            k, damping = case.springs[n].rate, case.springs[n].damping
            assert isinstance(damping, Damping)
            c, lost = damping.viscous, damping.loss_factor * k
            square = (k**2 + lost**2) * twist[n] + c**2 * rate[n] + 2 * c * lost * half[n]
            assert devices[n].torque_rms ** 2 == pytest.approx(square, rel=1e-5)


def test_a_converter_stills_what_would_drift() -> None:
    """By quadrature: pump and turbine are free, at rest relative to their mean speeds."""
    points = ((0.0, 2.5, 0.003), (0.5, 1.5, 0.0032), (0.9, 1.0, 0.0015), (1.0, 1.0, 0.0))
    shaft = Spring({2: 1, 3: -1}, stiffness=300.0, damping=1.0, name="shaft")
    case = Transmission(
        3, [], [], [Gear(speed_ratios={1: 0.7})], inertias={1: 0.4, 2: 0.2, 3: 5.0},
        springs=[shaft], converters=[Converter("TC", 1, 2, points)], load=Load(speed=1900),
    )  # fmt: skip
    [gear], [modal] = random_vibration(case, 1, White(1.0)), modes(case)
    assert modal.converters
    one = modal.converters["TC"]
    mass, stiffness, resistance = matrices(case)
    resistance += np.array([[one.A1, one.A2, 0], [-one.A3, -one.A4, 0], [0, 0, 0]])

    def twist(w: float) -> float:
        moved = np.linalg.solve(stiffness + 1j * w * resistance - w * w * mass, [1, 0, 0])
        return 2 * float(abs(moved[1] - moved[2])) ** 2

    pieces = [(1e-9, 0.1), (0.1, 1), (1, 10), (10, 60), (60, 1e4)]
    exact = sum(quad(twist, a, b, epsabs=0, epsrel=1e-10, limit=500)[0] for a, b in pieces)
    assert gear.devices["shaft"].twist_rms ** 2 == pytest.approx(exact, rel=1e-7)
    assert math.isnan(gear.links["1"].rms)
    assert gear.links["1"].velocity_rms > 0


def test_masses_behind_a_damper_alone_have_velocities_but_no_angles() -> None:
    """By quadrature: a shaft of 300 N*m/rad moves them through 2 N*m*s/rad, so that they drift."""
    springs = [Spring({1: 1, 2: -1}, 300.0), Spring({2: 1, 3: -1}, damping=2.0)]
    springs.append(Spring({3: 1, 4: -1}, 200.0, damping=1.0))
    case = sprung(4, springs, {3: 0.5, 4: 0.8})
    [gear] = random_vibration(case, 1, White(2.5), by="motion")

    def squared(omega: float) -> Array:
        [moved] = answers(case, 0, True, np.array([omega]))
        made: Array = 2 * 2.5 * omega**2 * np.abs(moved[2:]) ** 2
        return made

    integral, *_ = quad_vec(squared, 0, float(np.inf), epsrel=1e-9)
    links = [gear.links[name] for name in "34"]
    assert [one.velocity_rms**2 for one in links] == pytest.approx(integral.tolist(), rel=1e-7)
    assert np.isnan([one.rms for one in links]).all()


@pytest.mark.parametrize(("at", "resistance"), [(2, 5.0), (3, 5 * 4 / (5 + 4))])
def test_links_that_only_dampers_resist(at: int, resistance: float) -> None:
    """The velocity is T/d, with dampers in series: it varies as T, and its rate has no variance."""
    springs = [Spring({1: 1}, 100.0, damping=3.0), Spring({2: 1}, damping=5.0)]
    springs.append(Spring({3: 1, 2: -1}, damping=4.0))
    case = sprung(3, springs, {1: 2.0})
    [gear] = random_vibration(case, at, Correlation(0.04, ((1.0, 0.3, 0.8),)))
    link = gear.links[str(at)]
    assert link.velocity_rms == pytest.approx(0.2 / resistance, rel=1e-9)
    assert math.isnan(link.rms)
    assert math.isnan(link.acceleration_rms)
    assert gear.links["1"].rms == 0


@pytest.mark.parametrize("second", [0.0, 0.7])
def test_dampers_in_series_on_a_road(second: float) -> None:
    """The link between dampers of 3 and 6 N*m*s/rad makes of them a damper of 2 N*m*s/rad."""
    springs = [Spring({1: 1, 2: -1}, 90.0), Spring({2: 1, 3: -1}, 20.0)]
    series = [Spring({2: 1, 4: -1}, damping=3.0), Spring({4: 1, 3: -1}, damping=6.0)]
    whole = [Spring({2: 1, 3: -1}, damping=2.0)]
    road = Correlation(0.04, ((1.0, 0.3, second),))
    rms = []
    for dampers in (series, whole):
        case = sprung(4, [*springs, *dampers], {2: 0.5, 3: 4.0}).replace(output=3)
        [gear] = random_vibration(case, 1, road, by="motion")
        links = [gear.links[name] for name in "23"]
        rms.append([[one.rms, one.velocity_rms, one.acceleration_rms] for one in links])
    in_series, alone = rms
    np.testing.assert_allclose(in_series, alone, rtol=1e-9)


@needs("vehicle")
def test_life_of_a_device_with_a_fatigue_strength() -> None:
    """Damage a second = nu D^(m/2) I/(endurance^m N), I = 3.6191919 of exponent 3 (4.6)."""
    from vstatics.vehicle.case.fatigue import Fatigue

    strength = Fatigue(100e6, 3, 4e6, section_modulus=1e-6)
    [bare] = random_vibration(mass(), 1, White(1.0))
    wanted = 60e6 * 1e-6 / (200 * bare.devices["mount"].twist_rms)  # to a stress of 60 MPa
    case = mass().replace(fatigue={"mount": strength})
    [gear] = random_vibration(case, 1, White(wanted**2))
    one = gear.devices["mount"]
    assert one.life == pytest.approx((100 / 60) ** 3 * 4e6 / 3.6191919 / one.crossings, rel=1e-7)
    assert bare.devices["mount"].life is None
    [none] = random_vibration(mass(0.0).replace(fatigue={"mount": strength}), 1, White(1.0))
    assert none.devices["mount"].life is not None
    assert math.isnan(none.devices["mount"].life)


@each_seed(6, 200)
def test_accelerations_of_masses_in_a_row_on_a_road(seed: int) -> None:
    """On a damped tyre the next mass has no variance of it, as what acts follows such a rate.

    Every other mass has: by quadrature of the chain, its matrices written out here. On the last
    mass one spring acts alone, so it is the RMS of this force by the mass.
    """
    random = seeded(400 + seed)
    masses = [10 ** random.uniform(1.5, 3.5) for _ in range(random.randint(2, 4))]
    rates = [random.uniform(1e5, 2e6) for _ in masses]
    dampings = [0.03 * math.sqrt(c * m) for c, m in zip(rates, masses, strict=True)]
    tyre = random.choice([0.0, 1.0])
    dampings[-1] *= tyre
    size = len(masses)
    bare = chain([*masses, 0.0], rates, dampings)
    case = bare.replace(inertias={}, masses=dict(enumerate(masses, 1)), output=size)
    alpha, b = random.uniform(0.2, 2), random.choice([0.0, 0.7])
    road = Correlation(2e-4, ((1.0, alpha, b),), random.uniform(5, 25))
    [gear] = random_vibration(case, size + 1, road, by="motion")
    found = [gear.links[str(n)].acceleration_rms for n in range(1, size + 1)]
    assert math.isnan(found[-1]) == bool(tyre)
    still = case.replace(masses={}, inertias=case.masses)  # the same numbers as angles

    def squared(omega: float) -> Array:
        [moved] = answers(still, size, True, np.array([omega]))
        spectrum = float(road.at(np.array([omega]))[0])
        made: Array = omega**4 * np.abs(moved[:kept]) ** 2 * spectrum
        return made

    kept, infinite = size - bool(tyre), float(np.inf)
    integral, *_ = quad_vec(squared, 0, infinite, epsrel=1e-7)
    assert found[:kept] == pytest.approx(np.sqrt(2 * integral), rel=1e-5)
    [device, *_] = gear.devices.values()
    assert found[0] == pytest.approx(device.torque_rms / masses[0], rel=1e-9)


@pytest.mark.parametrize("speed", [None, 12.0])
def test_a_correlation_over_time_is_the_cosine_transform_of_its_spectrum(
    speed: float | None,
) -> None:
    """Without a speed alpha and beta are rates: R(t) = sum of D exp(-alpha t) cos(beta t)."""
    shares, pace = ((0.85, 0.45, 0.8), (0.15, 0.9, 0.1)), speed or 1.0
    road = Correlation(2e-4, shares, speed)
    for time in (0.3, 1.0):
        made, _ = quad(lambda one: 2 * float(road.at(one)), 0, np.inf, weight="cos", wvar=time)
        way = pace * time
        decayed = sum(part * math.exp(-a * way) * math.cos(b * way) for part, a, b in shares)
        assert made == pytest.approx(2e-4 * decayed, abs=1e-10)
