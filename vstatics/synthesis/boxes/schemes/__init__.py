"""Schemes of gearboxes in the order of the search, generated when they are needed.

`choices` adds the free choices of a scheme: meshed sets, a held link, ports. Schemes grow from
`stems`, or are composed of `parts` without a common link. `speeds` calculates the link speeds that
the gear sets of a scheme permit.
"""
