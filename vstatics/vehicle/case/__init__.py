"""Vehicle of a case, and fatigue strengths of components.

`vehicle`, `fatigue` and `bearing` declare the values. `vehicle_checks` and `fatigue_checks` check
them. `vehicle_key`, `fatigue_key` and `bearing_key` declare the keys of a document.
"""
