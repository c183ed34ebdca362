"""What a case says of its vehicle and of the fatigue strength of its components.

`vehicle` and `fatigue` are the values, `vehicle_keys` and `fatigue_keys` their keys in a document,
and `vehicle_checks` finds what contradicts itself.
"""
