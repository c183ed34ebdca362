"""Diagrams of the structure of a case: a stick diagram, or boxes for components of any kind.

`scheme` contains the links and components to draw, and `titles` their tooltips. `gear_glyphs`,
`sets` and `shift_element_symbols` (also of springs and the housing) draw components, and
`planetary` identifies planetary gear sets. `stick` draws the stick diagram: `coaxial` for one axis,
`axes` for several, `bare` for gear sets without teeth. `structure` shows each component as one of
the `boxes`, which `coaxial` arranges.
"""
