"""Springs in pictures of the scheme: they join what they join."""

from tests.pictures.drawn import texts
from tests.pictures.schemes.test_schemes import overlaps
from vstatics import Gear, Mechanism, ShiftElement, Spring, Transmission, solve
from vstatics.core.elements import Drawing, Element, transmission
from vstatics.core.model.springs import between
from vstatics.pictures import picture
from vstatics.pictures.drawing.gear_state import state_of
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.schemes.scheme import scheme_of, scheme_state

SPRINGS = [
    Spring(between(1, 2), stiffness=1, name="damper"),
    Spring(between(4), stiffness=1, name="mount"),
    Spring({3: 1, 4: -4.1, 5: 3.1}, stiffness=1, name="axle"),
]
ELEMENTS = [ShiftElement(2, 3, "C"), ShiftElement(3, 0, "B")]
GEARS = [Gear([1], name="on"), Gear([2], name="off")]
CASE = Transmission(5, ELEMENTS, [], GEARS, springs=SPRINGS)


def test_a_shaft_is_a_coupling_and_any_other_a_box_with_its_coefficients() -> None:
    scheme = scheme_of(CASE)
    shown = [(one.name, one.kind, one.members, one.is_coupling) for one in scheme.devices[2:]]
    assert shown == [
        ("damper", "spring", {"first": 1, "second": 2}, True),
        ("mount", "spring", {"first": 4, "second": 0}, True),
        ("axle", "spring", {"3": 3, "4": 4, "5": 5}, False),
    ]
    assert [one.is_on_housing for one in scheme.devices[2:]] == [False, True, False]
    assert scheme.devices[4].labels == {"3": "×1", "4": "×-4.1", "5": "×3.1"}
    assert scheme.ends == ([1], [5])  # no other link ends in the air
    loaded, idle = (
        {device.name for place, device in enumerate(scheme.devices) if place not in state.idle}
        for state in (scheme_state(scheme, state_of(solve(CASE), n)) for n in (1, 2))
    )
    assert {"damper", "mount", "axle", "C"} <= loaded
    assert idle == {"damper", "mount", "axle", "B"}  # the input stands: no torque is known


def test_springs_can_be_read_in_the_structure() -> None:
    for gears in ((), (1,), (2,)):
        figure = picture(solve(CASE), "structure", Style(), gears)
        shown = {"damper", "mount", "axle", "spring", "×−4.1", "×3.1", "×1"}
        assert shown <= {*texts(figure)}
        assert overlaps(figure) == []


def test_springs_stand_beside_drawn_elements() -> None:
    pair = Element("G", "gear_pair", {"first": 1, "second": 2}, {"first": 20, "second": 41})
    springs = [Spring(between(2, 3), stiffness=1, name="half"), SPRINGS[1]._replace(twist={3: 2})]
    for count, shown in ((1, {"half"}), (2, {"half", "mount", "×2"})):
        case = transmission(Drawing(3, [pair]), gears=[Gear()], springs=springs[:count])
        figure = picture(solve(case), "stick", Style())
        assert shown <= {*texts(figure)}
        assert count > 1 or overlaps(figure) == []


def test_one_mass_on_a_spring_is_drawn() -> None:
    case = Transmission(1, [], [], [], springs=[Spring(between(1), stiffness=3, name="s")])
    figure = picture(solve(case), "structure", Style("ru"))
    assert {*texts(figure)} == {"Структура", "1", "s"}
    boxed = case.replace(springs=[Spring({1: 2.0}, stiffness=3, name="s")])
    assert "пружина" in texts(picture(solve(boxed), "structure", Style("ru")))


def test_a_shaft_and_a_mechanism_have_one_state() -> None:
    """In the lever both ends of a shaft are joined to the input."""
    shaft = Spring(between(1, 2), stiffness=1)
    case = Transmission(4, [ShiftElement(3)], [Mechanism(2, 3, 4, -2.0)], [Gear([1])])
    case = case.replace(springs=[shaft])
    assert state_of(solve(case), 1).joined == [0, 1, 1, 0, 4]
