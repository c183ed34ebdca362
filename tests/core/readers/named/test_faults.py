"""Cases of `tests/bad` in YAML and JSON with one fault each: its place and the words about it.

The places were counted in the files, not taken from the program.
"""

import pytest

from tests.commands import BAD_FILES
from tests.installed import needs
from vstatics.core import readers
from vstatics.core.errors import ReadError

# file:line:column: words of the message; a line that is set in goes on with the one above
FAULTS = r"""
alias-of-itself.yaml:9:24: alias *gear is inside the part that it repeats
alias-unknown.yaml:9:18: alias *elements has no anchor before it
coast-quoted.yaml:2:8: coast: read 'true', expected `true` or `false` without quotes
coast-yes.yaml:2:8: coast: read 'yes', expected `true` or `false`
control-character.yaml:6:50: U+0007, a character that YAML does not allow
efficiency-above-1.yaml:6:64: mechanisms.D1.efficiency: read 97, expected an efficiency above 0
element-joins-itself.yaml:4:11: shift_elements.F2[2]: connects link 2 to itself
element-of-one-link.yaml:3:7: shift_elements.T1: read a list of 1, expected two links: [first
element-twice.yaml:9:27: gears.2.engaged[3]: shift element F2 is engaged twice
element-unknown.yaml:9:19: gears.2.engaged[1]: read 'F3', expected the name of a shift element:
engaged-not-a-list.yaml:9:18: gears.2.engaged: read 'F2', expected a list of shift elements
gear-not-a-mapping.yaml:9:8: gears.2: read 'F2', expected a list of shift elements, or a mapping
gears-empty.yaml:4:8: gears: `gears` is missing or empty
gears-missing.yaml:1:1: such as `gears: {"1": [T1]}`
housing-speed.yaml:9:33: gears.2.speeds.housing: read 0 (the housing), expected a link number from
idle-unknown.yaml:2:7: idle: read 'publish', expected `exact` or `published`; did you mean
    `published`?
input-is-output.yaml:2:9: output: input and output are both link 1
key-empty.yaml:9:3: gears: read an empty key, expected a name
key-is-a-list.yaml:9:3: a key that is a list or a mapping, expected text
key-twice.yaml:11:1: key `name` is given twice, the first is on line 2, column 1
key-unknown.yaml:7:1: unknown key `gaers`; did you mean `gears`?
link-fraction.yaml:6:36: mechanisms.D1.third: read '3.5', expected a link number
link-name-twice.yaml:1:20: links[3]: link 3 has the name of link 1, expected another name
link-named-housing.yaml:1:20: links[3]: `housing` is the housing, expected another name for link 3
link-octal.yaml:6:36: mechanisms.D1.third: read '03', expected a link number from 1 to 3
link-of-10000-digits.yaml:6:36: mechanisms.D1.third: read
    '9999999999999999999999999999999999999999...', expected a number of at most 9 digits
link-out-of-range.yaml:6:36: mechanisms.D1.third: read '4', expected a link number from 1 to 3
link-unknown-name.yaml:6:41: mechanisms.D1.third: read 'carier', expected the name of a link or
    `housing`; did you mean `carrier`?
links-too-many.yaml:1:8: links: read 100000000 links, but 2 shift elements and 1 mechanisms can
links-missing.yaml:1:1: `links` is missing
links-not-a-number.yaml:1:8: links: read 'three', expected the number of links or a list of their
mechanism-without-ratio.yaml:6:3: mechanisms.D1: `ratio` is missing
merge-key.yaml:9:9: expected a mapping, or a list of mappings, after the merge key `<<`
name-of-two-lines.yaml:2:7: name: read 'two\nlines', expected one line of text
nested-without-end.yaml:1:17: nested deeper than 16 levels
no-mapping.yaml:1:1: read a list, expected a case: a mapping with `elements`, `mechanisms`
number-hexadecimal.yaml:6:46: mechanisms.D1.ratio: read '0x10', expected a number or a calculation
number-infinite.yaml:6:46: mechanisms.D1.ratio: read '-.inf', expected a number
number-nan.yaml:6:46: mechanisms.D1.ratio: read '.nan', expected a number
number-sexagesimal.yaml:6:46: mechanisms.D1.ratio: read '1:30:15', expected a number
number-too-large.yaml:6:46: mechanisms.D1.ratio: read '1e999999999', expected a smaller number
number-with-comma.yaml:6:46: mechanisms.D1.ratio: read '-2,5', expected a number or a calculation
    such as -96/39 (with a decimal point)
number-with-underscore.yaml:6:46: mechanisms.D1.ratio: read '1_000', expected a number
number-with-word.yaml:6:46: mechanisms.D1.ratio: read 'abc', expected a number or a calculation
ratio-by-zero.yaml:6:46: mechanisms.D1.ratio: read '-96/0', expected a denominator other than 0
ratio-zero.yaml:6:46: mechanisms.D1.ratio: read 0, expected a ratio other than 0
speed-no-number.yaml:9:36: gears.2.speeds.2: read 'fast', expected a speed with its unit
speed-of-input.yaml:9:33: gears.2.speeds.1: link 1 is the input
tab.yaml:3:1: not YAML: read a tab, expected blanks
tag.yaml:6:46: tag !!python/name:os.system is not accepted
two-documents.yaml:10:1: a second document starts here
unclosed.yaml:8:21: not YAML
gears-null.json:1:1: gears: `gears` is missing or empty
comment.json:2:15: not JSON: read '//', expected a key in double quotes
cut-off.json:1:13: not JSON: read the end of the file, expected a key in double quotes
data-after-the-end.json:7:1: not JSON: read '{', expected the end of the file
half-a-character.json:2:11: half a character
infinity.json:4:71: not JSON: read '-Infinity', expected a value
key-twice.json:2:15: key `links` is given twice, the first is on line 2, column 3
key-unknown.json:4:62: mechanisms.D1: unknown key `ratoi`; did you mean `ratio`?
nan.json:4:71: not JSON: read 'NaN', expected a value
nested-without-end.json:1:17: nested deeper than 16 levels
number-too-large.json:4:71: mechanisms.D1.ratio: read '1e999', expected a smaller number
octal.json:2:12: not JSON: read '03', expected a value
single-quotes.json:2:3: not JSON: read ''links'', expected a key in double quotes
tab-in-text.json:2:13: not JSON: Invalid control character
trailing-comma.json:5:37: not JSON: read ']', expected no `,` before it
compliance-0.yaml:4:47: springs.damper.compliance: read 0, expected a compliance above 0
compliance-negative.yaml:4:47: springs.damper.compliance: read -0.00084, expected a compliance
compliance-too-small.yaml:4:47: springs.damper.compliance: read 1e-310, expected a compliance that
compliance-nan.yaml:4:47: springs.damper.compliance: read 'nan', expected a compliance
compliance-of-stiffness.yaml:4:47: springs.damper.compliance: read '84e-5 N*m/rad', expected a
    compliance in rad/(N*m), bare or with its unit; this is a stiffness
damping-negative.yaml:4:63: springs.damper.damping: read -3.2, expected a damping of 0 or more
damping-loss-factor-negative.yaml:4:77: springs.damper.damping.loss_factor: read -0.1
damping-ratio-negative.yaml:4:63: springs.damper.damping: read a ratio of -0.02, expected a ratio
damping-several.yaml:4:63: springs.damper.damping: read several of `viscous`, `ratio`
damping-a-list.yaml:4:63: springs.damper.damping: read a list, expected a damping, or a mapping
damping-of-rigid.yaml:10:56: mechanisms.M.damping: read a damping without `stiffness`: a rigid
stiffness-0.yaml:5:65: springs.axle.stiffness: read 0, expected a stiffness above 0
stiffness-infinite.yaml:5:65: springs.axle.stiffness: read '.inf', expected a stiffness
stiffness-of-clutch-negative.yaml:8:41: shift_elements.C.stiffness: read -100000
stiffness-of-mechanism-0.yaml:10:58: mechanisms.M.stiffness: read 0, expected a stiffness above 0
stiffness-of-torque.yaml:5:65: springs.axle.stiffness: read '9e4 N*m', expected a stiffness in
    N*m/rad, bare or with its unit; this is a torque
inertia-negative.yaml:2:26: inertias.disc: read -0.02, expected an inertia of 0 or more
inertia-decimal-comma.yaml:2:34: inertias: read '02 kg*m^2' without a value; in a number, write a
    decimal point
inertia-nan.yaml:2:32: inertias.disc: read '.nan', expected an inertia in kg*m^2, bare
inertia-of-housing.yaml:2:26: inertias.housing: read 0 (the housing), expected a link number from
inertia-of-unknown-link.yaml:2:26: inertias: read 'dics', expected the name of a link or
    `housing`; did you mean `disc`?
inertia-of-speed.yaml:2:32: inertias.disc: read '3 rpm', expected an inertia in kg*m^2, bare or
    with its unit; this is a speed
spring-both.yaml:5:3: springs.axle: read both `stiffness` and `compliance`, expected one of them
spring-neither.yaml:5:3: springs.axle: read none of `stiffness`, `compliance`, `points`
spring-equal-links.yaml:4:28: springs.damper.links[2]: connects link engine to itself, expected two
spring-links-and-twist.yaml:5:9: springs.axle: read both `links` and `twist`, expected one of them
spring-without-links.yaml:6:12: springs.support: expected `links`, the two links of a shaft
spring-twist-empty.yaml:5:17: springs.axle.twist: read an empty twist, expected at least one link
spring-twist-0.yaml:5:27: springs.axle.twist.wheel: read 0, expected a finite coefficient other
spring-unknown-link.yaml:4:28: springs.damper.links[2]: read 'dics', expected the name of a link
    or `housing`; did you mean `disc`?
spring-twist-unknown-link.yaml:5:18: springs.axle.twist: read 'dics', expected the name of a link
    or `housing`; did you mean `disc`?
spring-of-three-links.yaml:6:20: springs.support.links: read a list of 3, expected two links:
spring-named-like-a-mechanism.yaml:6:3: springs.M: `M` is also the name of a mechanism
mechanism-named-like-a-clutch.yaml:10:3: mechanisms.C: `C` is also the name of a shift element
springs-a-list.yaml:3:10: springs: read a list, expected a mapping: a name for each spring
static-below-1.yaml:6:13: shift_elements.FH.static: read 0.9, expected 1 or more
static-a-text.yaml:6:13: shift_elements.FH.static: read 'high', expected a number or a calculation
friction-a-number.yaml:7:15: shift_elements.FH.friction: read '0.12', expected a mapping
friction-radius-0.yaml:7:24: shift_elements.FH.friction.radius: read 0, expected a radius above 0
friction-area-of-pressure.yaml:7:35: shift_elements.FH.friction.area: read '60 kPa', expected an
    area in m^2, bare or with its unit; this is a pressure
friction-area-negative.yaml:7:35: shift_elements.FH.friction.area: read -0.006, expected an area
friction-area-missing.yaml:7:15: shift_elements.FH.friction: `area` is missing
friction-surfaces-fraction.yaml:7:54: shift_elements.FH.friction.surfaces: read '8.5'
friction-surfaces-0.yaml:7:54: shift_elements.FH.friction.surfaces: read '0', expected a whole
friction-coefficient-0.yaml:7:70: shift_elements.FH.friction.coefficient: read 0
friction-coefficient-negative.yaml:7:86: shift_elements.FH.friction.coefficient[2][2]: read -0.1
friction-points-empty.yaml:7:70: shift_elements.FH.friction.coefficient: read a list
friction-points-flat.yaml:7:81: shift_elements.FH.friction.coefficient[2]: read '10', expected 2
friction-points-of-three.yaml:7:81: shift_elements.FH.friction.coefficient[2]: read a list of 3
friction-table-without-rows.yaml:7:70: shift_elements.FH.friction.coefficient: `rows` is missing
friction-slip-negative.yaml:7:72: shift_elements.FH.friction.coefficient[1][1]: read -1
friction-slips-out-of-order.yaml:7:83: shift_elements.FH.friction.coefficient[2][1]: read 10,
    expected a slip of 20 rad/s or more: slips must ascend
spring-limit-0.yaml:9:58: springs.tyre.limit: read 0, expected a torque above 0
spring-limit-of-force.yaml:9:58: springs.tyre.limit: read a number in N, expected N*m: its twist
    names no link of `masses`
mass-and-inertia.yaml:1:22: masses.axle: link axle is in `inertias`, too: it either rotates
mass-below-0.yaml:1:10: masses.body: read -5, expected a mass of 0 or more
straight-in-turning-unit.yaml:3:33: springs.s.stiffness: read a number in N*m/rad, expected N/m:
    its twist names body, which is in `masses`
turning-in-straight-unit.yaml:3:48: springs.s.damping: read a number in N*s/m, expected N*m*s/rad:
    its twist names no link of `masses`
straight-points-in-rad.yaml:3:40: springs.s.points[2][1]: read a number in rad, expected m
damping-of-set-straight.yaml:4:63: mechanisms.M.damping: read a number in N*s/m, expected
    N*m*s/rad: the component rotates
strut-that-turns.yaml:3:30: springs.s.strut: the twist names no link of `masses`, expected at
    least one: a strut acts along a straight line
strut-half-counter-chamber.yaml:3:29: springs.s.strut: expected `counter_area`
strut-at-its-bottom.yaml:3:98: springs.s.strut.at: read -0.11, expected more than -0.11 and less
strut-beyond-numbers.yaml:3:29: springs.s.strut: its stiffness is infinite, expected realistic
strut-beside-stiffness.yaml:3:33: springs.s.stiffness: read `stiffness` with `strut`
strut-without-length.yaml:3:29: springs.s.strut: `length` is missing
limit-of-no-spring.yaml:4:61: springs.tyre.limit.of: read `raer`, expected the name of a spring;
    did you mean `rear`?
limit-of-a-limit.yaml:4:61: springs.tyre.limit.of: `rear` has a limit or friction of its own
limit-without-times.yaml:4:46: springs.tyre.limit: expected both `of` and `times`, or neither
limit-times-0.yaml:4:74: springs.tyre.limit.times: read 0, expected a number other than 0
"""
TABLE = dict(line.split(":", 1) for line in FAULTS.replace("\n    ", " ").strip().splitlines())


def test_each_fault_is_reported_alone_with_its_place_and_words() -> None:
    wrong = {}
    for file, expected in TABLE.items():
        with pytest.raises(ReadError) as caught:
            readers.read((BAD_FILES / file).read_bytes(), file)
        problem, *others = caught.value.problems
        assert problem.place is not None
        place, _, words = expected.partition(": ")
        found = f"{problem.place.line}:{problem.place.column}", problem.place.file, others
        if found != (place, file, []) or words not in problem.message:
            wrong[f"{file}:{expected}"] = str(caught.value)
        assert len(problem.message) < 250
    assert wrong == {}


def test_every_bad_file_is_in_the_table() -> None:
    files = {file.name for suffix in ("yaml", "json") for file in BAD_FILES.glob(f"*.{suffix}")}
    assert TABLE.keys() == files


CAR = """
output: wheels
links: [engine, turbine, shaft, wheels, pto]
outputs: [wheels, pto]
load: {speed: 2000 rpm, torque: 150 N*m}
mechanisms:
  TC: {kind: converter, first: engine, second: turbine, points: [[0, 2], [0.8, 1]]}
  axle: {first: turbine, second: shaft, ratio: 4}
  power take-off: {first: shaft, second: pto, ratio: 2}
springs: {half-shafts: {links: [shaft, wheels], stiffness: 9e3}}
inertias: {wheels: 40}
gears: {drive: {speed_ratios: {TC: 0.7}}}
vehicle: {mass: 1200 kg, radius: 300 mm}
"""
"""The mass of this car is an inertia of 1200 kg * (0.3 m)^2 = 108 kg*m^2, so 40 kg*m^2 at the
wheels do not contain it.
"""


@pytest.mark.parametrize(
    "value",
    [
        "1200 kg",
        "300 mm",
        "converter",
        "{kind: converter, first: engine, second: turbine, points: [[0, 2], [0.8, 1]]}",
        "wheels",
        "[0, 2]",
        "2000 rpm",
        "150 N*m",
        "{wheels: 40}",
    ],
)
@needs("vehicle")
def test_a_value_that_cannot_be_read_is_compared_with_no_other_value(value: str) -> None:
    with pytest.raises(ReadError) as caught:
        readers.loads(CAR.replace(value, "'?'", 1))
    assert [problem.message.count("read '?'") for problem in caught.value.problems] == [1]
