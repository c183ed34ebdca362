"""Models of what the standard library of Modelica has not.

Names and texts of a case as those of Modelica.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from vstatics.errors import printable

LIBRARY = "Modelica.Mechanics.Rotational"

THREE_LINK = "ThreeLink"
_THREE_LINK = f"""\
  model ThreeLink "Three links: w_first - w_third = u (w_second - w_third)"
    parameter Real u "Internal ratio";
    {LIBRARY}.Interfaces.Flange_a first;
    {LIBRARY}.Interfaces.Flange_a second;
    {LIBRARY}.Interfaces.Flange_a third;
  equation
    first.phi - third.phi = u*(second.phi - third.phi);
    second.tau = -u*first.tau;
    third.tau = (u - 1)*first.tau;
  end ThreeLink;
"""
_ELASTIC = """\
  model {name} "Torque by a twist, the sum of coefficients times angles"
    parameter Real c(unit = "N.m/rad") "Stiffness";
    parameter Real d(unit = "N.m.s/rad") = 0 "Damping";
{declared}\
    Real twist(unit = "rad");
    Real rate(unit = "rad/s");
    Real tau(unit = "N.m") "On a link of coefficient 1";
  equation
    twist = {total};
    rate = der(twist);
    tau = c*twist + d*rate;
{torques}\
  end {name};
"""
_SHARED = """\
  model {name} "A mass whose speed is the sum of coefficients times speeds"
    parameter Real J(unit = "kg.m2") "Inertia";
{declared}\
    Real phi(unit = "rad");
    Real w(unit = "rad/s");
    Real a(unit = "rad/s2");
    Real tau(unit = "N.m") "That moves it";
  equation
    phi = {total};
    w = der(phi);
    a = der(w);
    tau = J*a;
{torques}\
  end {name};
"""
_TEXTS = {"ElasticLinks": _ELASTIC, "SharedInertia": _SHARED}


def own_names(links: int) -> list[str]:
    """The names of all models, for up to so many links."""
    return [THREE_LINK, *(f"{name}{n}" for name in _TEXTS for n in range(1, links + 1))]


def own_model(name: str, links: int) -> str:
    """The text of a model, for so many links: flange1, flange2 and so on.

    >>> print(own_model("ElasticLinks", 2).splitlines()[-2])
        flange2.tau = k2*tau;
    """
    if name == THREE_LINK:
        return _THREE_LINK
    places = range(1, links + 1)
    declared = [
        f'    parameter Real k{place} "Coefficient";\n'
        f"    {LIBRARY}.Interfaces.Flange_a flange{place};\n"
        for place in places
    ]
    return _TEXTS[name].format(
        name=f"{name}{links}",
        declared="".join(declared),
        total=" + ".join(f"k{place}*flange{place}.phi" for place in places),
        torques="".join(f"    flange{place}.tau = k{place}*tau;\n" for place in places),
    )


_RESERVED = frozenset(
    re.findall(
        r"\w+",
        "algorithm and annotation assert block break class connect connector constant "
        "constrainedby der discrete each else elseif elsewhen encapsulated end enumeration "
        "equation expandable extends external false final flow for function if import impure in "
        "initial inner input loop model not operator or outer output package parameter partial "
        "protected public pure record redeclare replaceable return stream then time true type "
        "when while within Boolean Clock ExternalObject Integer Modelica Real StateSelect String",
    )
)
"""Words of the language, and names that stand for something: between quotes they do not."""
_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_]*\Z")
_NOT_BETWEEN_QUOTES = re.compile(r"[^A-Za-z0-9_!#$%&()*+,\-./:;<>=?@\[\]^{}|~ ]")


def identifier(name: str) -> str:
    r"""A name as an identifier: as it is, or between quotes.

    Signs that no identifier may have become underlines.

    >>> identifier("FH"), identifier("in"), identifier("set 0"), identifier("Ф's")
    ('FH', "'in'", "'set 0'", "'__s'")
    """
    if _PLAIN.match(name) and name not in _RESERVED:
        return name
    return f"'{_NOT_BETWEEN_QUOTES.sub('_', name)}'"


class Identifiers:
    """Identifiers of one scope, each given once.

    Examples
    --------
    >>> names = Identifiers()
    >>> names.new("out"), names.new("out"), names.new("in"), names.new("in")
    ('out', 'out_2', "'in'", 'in_2')
    """

    def __init__(self, taken: Iterable[str] = ()) -> None:
        self._taken = set(taken)

    def new(self, name: str) -> str:
        """The identifier of a name, with a number behind it if it is taken."""
        made, number = identifier(name), 1
        while made in self._taken:
            number += 1
            made = identifier(f"{name}_{number}")
        self._taken.add(made)
        return made


def class_name(name: str) -> str:
    """The name of a class, which is that of a file too: one word of letters.

    >>> class_name("Dump-truck gearbox"), class_name("8HP"), class_name("")
    ('Dump_truck_gearbox', 'Case_8HP', 'Case')
    """
    word = re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_")[:60]
    plain = _PLAIN.match(word) and word not in _RESERVED
    return word if plain else f"Case_{word}".rstrip("_")


def string(text: str) -> str:
    r"""A text between double quotes.

    >>> print(string('a "b" \\ c'))
    "a \"b\" \\ c"
    """
    safe = printable(text, lines=True).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{safe}"'
