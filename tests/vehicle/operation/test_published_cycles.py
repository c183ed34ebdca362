"""Driving cycles as they are published: the same cycle in hundreds of layouts, by exact sums."""

import math
import resource
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from random import Random

import numpy as np
import pytest

from tests.chance import each_seed, seeded, seeds_with_slow
from tests.commands import process
from tests.core.readers.named.test_signs_of_print import spoilt
from tests.vehicle.operation.cycles import cycled
from vstatics import CaseError, Gear, Mechanism, ReadError, Transmission
from vstatics.core.numerics.constants import AIR, GRAVITY
from vstatics.vehicle.case.vehicle import Vehicle
from vstatics.vehicle.operation.trace import read_trace

CAR = Vehicle(1200, 0.3, 0.012, 0.65, 4.1)
CASE = Transmission(2, [], [Mechanism(1, 2, 0, 3.5, 0.9, name="p")], [Gear(name="1")], vehicle=CAR)

TIMES = {"s": Fraction(1), "secs": Fraction(1), "seconds": Fraction(1), "ms": Fraction(1, 1000)}
SPEEDS = {
    "m/s": Fraction(1),
    "mps": Fraction(1),
    "km/h": Fraction(10, 36),
    "kph": Fraction(10, 36),
    "mph": Fraction(44704, 100000),  # 1 mile of 1609.344 m in 3600 s
    "mi/h": Fraction(1609344, 3600000),
}
GRADES = {"grade": 1, "Grade [-]": 1, "grade [%]": 100, "Gradient (%)": 100, "cycGrade": 1}
GRADES |= {"gradient [‰]": 1000}
IMPLIED = {
    **dict.fromkeys(("Seconds", "sec", "Sec", "s", "SECS", "second", "cycSecs", "<t>"), "s"),
    **dict.fromkeys(("cycMps", "mps", "m/s"), "m/s"),
    **dict.fromkeys(("<v>", "km/h"), "km/h"),
    "MPH": "mph",
}
"""Headings with a unit of their own."""
TIME = [name for name, unit in IMPLIED.items() if unit == "s"]
TIME += ["time", "Time", "TIME", "t", "Test Time", "Elapsed_Time"]
SPEED = ["speed", "Speed", "SPEED", "v", "Target Speed", "Vehicle speed"]
SPEED += ["cycMps", "<v>", "MPH", "km/h", "m/s"]
OTHERS = ("Phase", "cycRoadType", "Distance, m", "Remark", "Acceleration (m/s^2)")


class Layout:
    """A cycle of whole thousandths, and a file of it: times [s], speeds [m/s], grades [-]."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.separator = rng.choice(",;\t")
        self.comma = self.separator != "," and rng.random() < 0.4
        time, time_unit = self.heading(TIME, TIMES)
        speed, speed_unit = self.heading(SPEED, SPEEDS)
        steep = rng.choice([None, "slope", *GRADES])
        fine = 1 if self.separator == "," else 10  # 1.200 may be 1200 where commas are decimal
        rows = [(0, 0, 0)]
        for _ in range(rng.randint(2, 8)):
            later = rows[-1][0] + fine * rng.randint(1001, 9999)
            rows.append((later, fine * rng.randint(1, 3999), rng.randint(-99, 99)))
        self.times = [Fraction(row[0], 1000) * time_unit for row in rows]
        self.speeds = [Fraction(row[1], 1000) * speed_unit for row in rows]
        size = GRADES.get(steep or "", 1)
        self.grades = [Fraction(row[2] if steep else 0, 1000 * size) for row in rows]
        self.is_sine = steep == "slope"
        names = [time, speed, *([steep] if steep else [])]
        columns = [(name, [self.number(row[k]) for row in rows]) for k, name in enumerate(names)]
        self.others = rng.sample(OTHERS, rng.randint(0, 2))
        columns += [(name, [rng.choice(["1", "city"]) for _ in rows]) for name in self.others]
        rng.shuffle(columns)
        self.data = self.written(columns)

    def heading(self, names: Sequence[str], units: dict[str, Fraction]) -> tuple[str, Fraction]:
        """A heading with its unit, and the size of that."""
        name = self.rng.choice(names)
        if name in IMPLIED:
            return name, units[IMPLIED[name]]
        unit = self.rng.choice(list(units))
        size = units[unit]
        unit = self.rng.choice([unit, unit, unit.upper(), unit.title()])
        styles = [f"{name} [{unit}]", f"{name} ({unit})", f"{name}({unit})", f"{name}, {unit}"]
        return self.rng.choice([*styles, f"{name}_{unit}"]), size

    def number(self, thousandths: int) -> str:
        """A number in the layout's way."""
        text = f"{'-' * (thousandths < 0)}{abs(thousandths) // 1000}.{abs(thousandths) % 1000:03}"
        text = text.rstrip("0").rstrip(".") if self.separator != "," else text
        return text.replace(".", ",") if self.comma else text

    def cell(self, text: str) -> str:
        """A cell, in quotes where it has to be, or by chance."""
        needs_quotes = self.separator in text
        return f'"{text}"' if needs_quotes or self.rng.random() < 0.1 else text

    def written(self, columns: list[tuple[str, list[str]]]) -> bytes:
        """The file."""
        rng = self.rng
        end = self.separator * rng.choice([0, 0, 1, 3])
        # https://github.com/OasisLMF/ktools/issues/22: a blank before the quotes of a cell
        between = self.separator + rng.choice(["", " "])
        lines = [
            between.join(map(self.cell, row)) + end
            for row in zip(*([name, *cells] for name, cells in columns), strict=True)
        ]
        titles = ["FTPCOL.TXT\tFederal Test Procedure", "A cycle, by time and speed", "# of 1975"]
        titles += ["1874", "Title 2020, 5", "1,2", "3\t4", "5;6;7", "-1.5"]
        is_number_first = columns[0][1][0] not in {"1", "city"}
        for _ in range(rng.randint(0, 2) if is_number_first else 0):
            lines.insert(rng.randint(1, len(lines)), rng.choice(["# a hill", "% a hill", "", "  "]))
        lines = [*rng.sample(titles, rng.randint(0, 4)), *[""] * rng.randint(0, 2), *lines, ""]
        text = rng.choice(["\n", "\r\n", "\r"]).join(lines)
        return text.encode(rng.choice(["utf-8", "utf-8-sig", "utf-16"]))


@seeds_with_slow(1, 8, 100)
def test_layouts_of_published_cycles(seed: int) -> None:
    """Distance by exact fractions; work at the wheels by the equation of motion, row by row."""
    for number in range(30):
        layout = Layout(seeded(4601 + 100 * seed + number))
        trace = read_trace(layout.data, "cycle.txt")
        lengths = [later - time for time, later in pairwise(layout.times)]
        pairs = [*pairwise(layout.speeds)]
        means = [(v + later) / 2 for v, later in pairs]
        sines = [float(g) / (1 if layout.is_sine else math.hypot(1, g)) for g in layout.grades][:-1]
        np.testing.assert_allclose(trace.duration, [float(dt) for dt in lengths], rtol=1e-12)
        np.testing.assert_allclose(trace.speed, [float(v) for v in means], rtol=1e-13)
        np.testing.assert_allclose(trace.slope, sines, rtol=1e-13)
        assert sorted(trace.table.head.skipped) == sorted(layout.others), layout.data
        driven = cycled(CASE, trace)
        way = [v * dt for v, dt in zip(means, lengths, strict=True)]
        assert driven.distance == pytest.approx(float(sum(way)), rel=1e-12)
        work = [
            1200 * float((later - v) * mean)
            + (1200 * GRAVITY * (0.012 + sine) + AIR * 0.65 / 2 * float(mean) ** 2) * float(step)
            for (v, later), mean, sine, step in zip(pairs, means, sines, way, strict=True)
        ]
        size = math.fsum(map(abs, work))
        assert driven.energy.wheels == pytest.approx(math.fsum(work), abs=1e-11 * size)
        noted = [message.id for message in driven.messages if message.id == "N005"]
        assert noted == ["N005"] * bool(layout.others)


def test_units_below_names_keep_gears_and_agree_with_units_beside_names() -> None:
    """Two units of one column, or an unknown unit, are errors, because a guess could be wrong."""
    for text in (
        "WLTC\nt;v;gear\n[s];[km/h];[-]\n0;0;1\n2;36;1\n",
        'WLTC\nt;v;gear\n"(s)";(km/h);\n0;0;1\n2;36;1\n',
        "t,v,gear\ns,km/h,gear\n0,0,1\n2,36,1\n",
        "# t,v,gear\n# s,km/h\n0,0,1\n2,36,1\n",
        "t [s],v,gear\n,[km/h]\n0,0,1\n2,36,1\n",
        "t,v,gear\n,km/h,\n00:00:00,0,1\n00:00:02,36,1\n",
        "t [s],v [km/h],gear\ns,km/h,-\n0,0,1\n2,36,1\n",
    ):
        trace = read_trace(text.encode(), "t.csv")
        assert (trace.gears, trace.speed.tolist()) == (["1"], [pytest.approx(5.0)])
    for head, said in (
        ("WLTC\nt;v\ns;knots", ":3:3: .*speed: read the unit 'knots', .* `m/s`, `km/h` or `mph`"),
        ("WLTC\nt;v\na;b", ":3:1: error: time: read the unit 'a', expected a time"),
        ("WLTC\nt;v\n;1", ":2:1: error: time: its unit is missing"),
        ("t [s];v [m/s]\ns;km/h", ":2:3: .*'km/h' below the unit 'm/s', expected one unit"),
    ):
        with pytest.raises(ReadError, match=said):
            read_trace(f"{head}\n0;0\n2;36\n".encode(), "t.csv")


SINE = math.sin(math.radians(3))

KMH, MPH, MPS = (f"time [s],speed [{unit}]" for unit in ("km/h", "mph", "m/s"))


def test_headings_of_further_programs() -> None:
    for text, slope in (
        ("time_seconds,speed_meters_per_second,grade\n0,0,0.75\n2,10,0\n", 0.6),
        ("timestep_time;vehicle_slope;vehicle_speed\n0.0;3.0;0.0\n2.0;3.0;10.0\n", SINE),
        ("time [s];vehicle_speed [km/h];slope [°]\n0;0;-3\n2;36;-3\n", -SINE),
        ("time [s];speed [km/h];slope [rad]\n0;0;0.05236\n2;36;0\n", math.sin(0.05236)),
        ("time [s],speed [km/h],Incline (°)\n0,0,-3\n2,36,-3\n", -SINE),
        ("t / s;v / (km/h);grade_percent;Speed/Limit\n0;0;75;9\n2;36;75;9\n", 0.6),
        ("time [hh:mm:ss];speed [km/h];grade\n07:59:59,5;0;0,75\n08:00:01,5;36;0,75\n", 0.6),
        ("time [min],speed [km/h],grade\n0:1:30,0,0.75\n00:01:32.0,36,0.75\n", 0.6),
        # dates and zones, as in https://github.com/OpenRailAssociation/osrd/issues/9345
        (f"{KMH},grade\n2024-02-29 23:59:59,0,0.75\n2024-03-01 00:00:01,36,0.75\n", 0.6),
        (f"{KMH},grade\n2024-02-29T23:59Z,0,0.75\n2024-03-01T01:59:02+02:00,36,0.75\n", 0.6),
        # dates with the day first, as in https://github.com/wireservice/csvkit/issues/876
        (f"{KMH},grade\n31.07.2017 23:59:59,0,0.75\n01.08.2017 00:00:01,36,0.75\n", 0.6),
        # a heading without a unit, as in https://github.com/IBA-Group-IT/IoT-data-simulator/issues/19
        ("datetime,mps,Inclination [%]\n2021-12-25T00:58Z,0,75\n2021-12-25T00:58:02Z,10,75\n", 0.6),
        ("time;speed [km/h];grade\n# 7 am\n 07:59:59;0;0.75\n08:00:01;36;0.75\n", 0.6),
        # https://github.com/GoldenCheetah/GoldenCheetah/issues/1288: headings that are units
        ("Minutes,Km/h,grade\n0,0,0.75\n0.033333333333333333,36,0\n", 0.6),
        # https://github.com/mendhak/gpslogger/issues/634, a log whose speeds are in m/s
        ("time,lat,GPS speed (m/s),grade\n12:00:00,1,0,0.75\n12:00:02,1,10,0\n", 0.6),
        # a log of Torque Pro: https://github.com/spirokai/OVRLEY/issues/15
        ("Time (s), Altitude,Speed (OBD)(km/h),Grade\n0,5,0,0.75\n2,5,36,0\n", 0.6),
    ):
        trace = read_trace(text.encode(), "t.csv")
        assert trace.duration.tolist() == [2.0]
        assert trace.speed.tolist() == [pytest.approx(5.0)]
        assert trace.slope.tolist() == [pytest.approx(slope)]


def test_a_cycle_over_distance_is_not_taken_for_a_cycle_over_time() -> None:
    """NatLabRockies/fastsim/issues/305; `<s>` and `<t>` are the headings of VECTO."""
    with pytest.raises(ReadError, match=r"heading '<s>', expected `time \[s\]`, [^;]*; the line"):
        read_trace(b"<s>,<v>,<grad>,<stop>\n0,0,0,5\n100,50,1,0\n", "t.csv")


def test_gears_of_published_cycles() -> None:
    text = "time [s],speed [m/s],gear\n0,0,0\n1,0,1.0\n2,5,1\n3,5,0\n4,5,1\n"
    trace = read_trace(text.encode(), "t.csv")
    with pytest.raises(CaseError, match="no gear `0`, expected one of ") as raised:
        cycled(CASE, trace)
    assert [problem.path for problem in raised.value.problems] == [(3,)]
    text = text.replace("5,0", "5,1")
    driven = cycled(CASE, read_trace(text.encode(), "t.csv"))
    assert list(driven.gears) == ["1"] * 4
    starts = "time [s],speed [m/s],gear\n0,0,{0}\n1,0,{0}\n2,5,1\n3,0,{0}\n4,0,{0}\n"
    start, same = (
        cycled(CASE, read_trace(starts.format(gear).encode(), "t.csv")) for gear in ("0", "1")
    )
    assert start.energy == same.energy


def test_faults_of_published_cycles_quote_the_file() -> None:
    for text, said in (
        ("Zeit;Tempo [km/h]\n0;0\n1;5\n", r"1:1: error: .*is `Zeit;Tempo \[km/h\]`, .*row `0;0`"),
        ("City cycle\ntmie [s],speed [km/h]\n0,0\n", ":2:1: error: .*'tmie .*did you mean `time`"),
        (f"{KMH},gaer\n0,0,1\n1,5,1\n", "read the heading 'gaer'.*mean `gear`"),
        ("FTP-75\n1874\ntime [s],speed [mile]\n0,0\n1,5\n", ":3:10: .*: read the unit 'mile'"),
        ("time,speed [km/h]\n0,0\n1,5\n", "time: its unit is missing, such as `time.*`time,speed"),
        ("FTP\n1874\nZeit,Tempo\n0,0\n1,5\n", ":3:1: .*'Zeit'.*`Zeit,Tempo`, the first row `0,0`"),
        ("time [s],speed [KM]\n0,0\n1,5\n", "speed: read the unit 'KM', expected a velocity"),
        ("time [s],v [mph],speed [mph]\n0,0,0\n1,5,5\n", "two columns are called `speed`"),
        (f"{MPH},slope,grade\n0,0,0,0\n1,5,0,0\n", "both `slope` and `grade`"),
        ("0,0\n1,5\n2,7\n", "read the heading '0'"),
        ("time [s],speed [km/h],gear number,duration [s],gear\n", "these are time steps"),
        ("time [s]\n0\n1\n", "`speed .km/h.` is missing"),
        (f"{MPH},slope,grade [deg]\n0,0,0,0\n1,5,0,0\n", "read both `slope` and `grade`"),
        (f"{MPH},grade\n0,0,0.5\n1,5,2.5\n", ":3:1: error: grade: read 2.5, expected -1 to"),
        # names as R writes them: github.com/tidyverse/readr/issues/130
        (',"time..s.","speed..km.h."\n1,0,0\n2,1,5\n', "'time..s.'.* did you mean `time`"),
        # github.com/okfn/messytables/pull/113
        ("time [s]|speed [m/s]\n0|0\n1|5\n", "separate the cells by commas, semicolons or tabs"),
        (f"{MPH},slope [deg]\n0,0,91\n1,5,0\n", "slope: read .*, expected -1 to 1"),
        (f"{MPS}\n0,0\n1,1e300\n", ":3:1: .*speed: read 1e.300 m/s, expected at most 1e"),
        (f"{MPS}\n0,0\n1e300,1\n", ":3:1: .*time: read 1e.300, expected at most 1e"),
        (f"{MPS}\n00:10,0\n00:20,1\n", ":2:1: .*finite number or a time such as `01:30:00`"),
        (f"{MPS}\n{'9' * 309}:00:00,0\n1,1\n", ":2:1: .* or a time such as `01:30:00`"),
        (f"{MPS}\n2024-02-30 00:00,0\n1,1\n", ":2:1: .* or a time such as `01:30:00`"),
        # a clock that passes midnight: github.com/leo-holanda/logcharts.io/issues/7
        (f"{MPS}\n23:59:50,0\n00:00:02,1\n", ":3:1: .*read 2 s after 86390 s.*; if .*midnight"),
        (f"{MPS}\n0,0\n1e-300,1\n", ":3:1: .*speed: read 1 m/s, expected a change by"),
        (f"{MPS}\n0,0\n1,-1\n", ":3:1: .*speed: read -1 m/s, expected 0 or more"),
    ):
        with pytest.raises(ReadError, match=said):
            read_trace(text.encode(), "t.csv")


@each_seed(20, 500)
def test_wild_numbers_of_a_trace_end_in_numbers_or_at_their_line(seed: int) -> None:
    """Numbers of any size: no warning of NumPy, no infinite energy."""
    rng = seeded(4700 + seed)

    def wild() -> str:
        return repr(rng.choice([0.0, rng.random(), 10.0 ** rng.randint(-320, 308)]))

    for _ in range(20):
        rows = [f"{wild()},{wild()}" for _ in range(3)]
        try:
            trace = read_trace("\n".join(["time [s],speed [m/s]", *rows]).encode(), "t.csv")
        except ReadError as error:
            problems = error.problems
        else:
            problems, driven = [], cycled(CASE, trace)
            assert math.isfinite(driven.energy.engine or 0.0)
            assert math.isfinite(driven.distance)
        assert all(problem.place and problem.place.line > 1 for problem in problems)


@each_seed(10, 200)
def test_blanks_of_print_are_blanks_in_tables(seed: int) -> None:
    cycle = "Time (s), Speed [km/h], Remark\n0, 0 , a b\n 2 ,36, c d\n"
    trace = read_trace(spoilt(cycle, seeded(5100 + seed)).encode(), "t.csv")
    assert (trace.duration[0], trace.speed[0]) == (2.0, pytest.approx(5.0))
    assert trace.table.head.skipped == ["Remark"]


@pytest.mark.slow
@pytest.mark.alone  # measures the largest of all processes that the test has started
def test_a_million_rows_take_500_mb(folder: Path) -> None:
    text = "links: [a, b]\nmechanisms: {p: {first: a, second: b, ratio: 4, efficiency: .97}}\n"
    vehicle = 'gears: {"1": []}\nvehicle: {mass: 1000, radius: 0.5}\n'
    (folder / "car.yaml").write_text(text + vehicle)
    speeds = np.abs(np.cumsum(np.random.default_rng(4800).normal(size=1_000_000)))
    rows = "".join(f"{k / 10},{v:.3f}\n" for k, v in enumerate(speeds.tolist()))
    (folder / "t.csv").write_text("time [s],speed [km/h]\n" + rows)
    assert process("cycle", "car.yaml", "t.csv", cwd=folder)[0] == 0
    assert resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss < 500e3
