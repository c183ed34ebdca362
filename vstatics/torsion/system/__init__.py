"""Torsional system of a gear: its bodies, elastic components and rigid components.

`state` finds the gears that can vibrate, and `slopes` the stiffnesses of springs with points under
the load. `working_points` finds the operating points of `converters`. `gear_system` builds the
system with a row for each device; `coordinates` splits the motions into free, massless and rigid
motions.
"""
