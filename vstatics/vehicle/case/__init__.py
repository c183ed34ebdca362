"""What a case says of its vehicle and of the fatigue strength of its components.

`vehicle` and `fatigue` are the values, `vehicle_checks` and `fatigue_checks` find what contradicts
itself, and `vehicle_key` and `fatigue_key` declare their keys in a document for the core.
"""
