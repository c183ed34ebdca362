"""Models of what the standard library of Modelica has not."""

from __future__ import annotations

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
