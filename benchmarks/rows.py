"""The rows of the table, in its order: a calculation, its peer, and the function that measures."""

from __future__ import annotations

from functools import partial

from benchmarks import boxes, gears, motions, torsion
from benchmarks.measuring import Row

MZKT, ZF = "mzkt7922.dat", "zf-8hp70.yaml"
LOOP = "C, in a shell loop"
ONE_JOB = "one job"
CASES = "loop over cases"
EIGH = "`scipy.linalg.eigh`"
BDF = "BDF, friction smoothed"

_similar = gears.similar_variants
_random = gears.random_variants
_any_sign = partial(_random, most=4.0, signs=(1, -1))
_VARIANTS = (
    Row("variant of MZKT 7922, six gears", "C", partial(_similar, units=1)),
    Row("variant of two MZKT 7922 in series", "C", partial(_similar, units=2)),
    Row("variant of eight MZKT 7922 in series", "C", partial(_similar, units=8)),
    Row("MZKT 7922, ratios within 10 %", "C", partial(_random, file=MZKT, most=1.1)),
    Row("MZKT 7922, ratios within a factor of 4, any sign", "C", partial(_any_sign, file=MZKT)),
    Row("ZF 8HP70, ratios within 10 %", "C", partial(_random, file=ZF, most=1.1)),
    Row("ZF 8HP70, ratios within a factor of 4, any sign", "C", partial(_any_sign, file=ZF)),
    Row("MZKT 7922, swept to NPZ", "C, without a file", partial(gears.long_sweep, count=2_000_000)),
    Row("operating point, 1,000 per call", CASES, partial(gears.operating_points, count=1_000)),
    Row("operating point, 100,000 per call", CASES, partial(gears.operating_points, count=100_000)),
)
_COMMANDS = (
    Row("deck to tables, 1,000 per run", LOOP, partial(gears.many_decks, output=("-o", "{}/"))),
    Row(
        "deck to JSON lines, 1,000 per run",
        LOOP,
        partial(gears.many_decks, output=("-f", "jsonl", "-o", "{}/all.jsonl")),
    ),
    Row("`vstatics run`", "import of NumPy and click", gears.one_run),
    Row(
        "`vstatics plot --kind stick`",
        "import of Matplotlib",
        partial(gears.one_document, words=("plot", "--kind=stick", "--gear=1", "-o", "stick.svg")),
    ),
    Row(
        "`vstatics report`",
        "import of Matplotlib",
        partial(gears.one_document, words=("report", "-o", "report.html")),
    ),
    Row("two processes that share nothing", "one process", gears.two_loops),
    Row(
        "10,000,000 variants to NPZ, two jobs",
        ONE_JOB,
        partial(gears.two_jobs, count=10_000_000, file="out.npz"),
    ),
    Row(
        "1,000,000 variants to CSV, two jobs",
        ONE_JOB,
        partial(gears.two_jobs, count=1_000_000, file="out.csv"),
    ),
)
_modes, _varied, _dump = torsion.modes_of_a_chain, torsion.varied_stiffness, motions.dumped_clutch
_TORSION = (
    Row("all modes of ten masses", EIGH, partial(_modes, masses=10, count=10)),
    Row("20 modes of 2,000 masses", EIGH, partial(_modes, masses=2_000, count=20)),
    Row("one varied stiffness, three masses", EIGH, partial(_varied, masses=3, springs=1)),
    Row("one varied stiffness, ten masses", EIGH, partial(_varied, masses=10, springs=1)),
    Row("two varied stiffnesses, three masses", EIGH, partial(_varied, masses=3, springs=2)),
    Row("two varied stiffnesses, ten masses", EIGH, partial(_varied, masses=10, springs=2)),
)
_MOTIONS = (
    Row("two shifts in 6 s", BDF, motions.box_shifts),
    Row("clutch dumped at once", BDF, partial(_dump, engaged="at once")),
    Row("clutch dumped in 0.02 s", BDF, partial(_dump, engaged="in 0.02 s")),
    Row("clutch dumped by a formula", BDF, partial(_dump, engaged="by a formula")),
    Row("closed-loop upshift in 3 s", BDF, motions.closed_loop),
    Row("variant of a shift, swept", "loop over `simulate`", motions.swept_shifts),
)
_BOXES = "C, one gear of each gearbox"
_SEARCHES = (
    Row("search for six speeds, three sets", _BOXES, boxes.six_speeds),
    Row("search for eight speeds, four sets", _BOXES, boxes.eight_speeds, is_long=True),
)
ROWS = (*_VARIANTS, *_COMMANDS, *_TORSION, *_MOTIONS, *_SEARCHES)
