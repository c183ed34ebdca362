"""Vehicle of a case, and fatigue strengths of components.

`vehicle` and `fatigue` declare the values, `vehicle_checks` and `fatigue_checks` check them, and
`vehicle_key` and `fatigue_key` declare the keys of a document.
"""
