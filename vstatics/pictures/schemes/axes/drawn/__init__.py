"""Drawing of several axes.

`links` draws links and ports, `marks` draws stations on a single axis, and `wheels` draws gear
pairs.
"""
