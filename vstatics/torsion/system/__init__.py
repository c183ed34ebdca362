"""Torsional system of a gear: its bodies, elastic components and rigid components.

`state` finds the gears that can vibrate, and `slopes` the stiffnesses of nonlinear springs under
load. `working_points` finds the operating points of `converters`. `gear_system` builds the system,
with a row for each component. `coordinates` splits its motions into massless, rigid and other
motions.
"""
