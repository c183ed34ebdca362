"""Drawing of several axes.

`links` draws links, inputs and outputs, `marks` draws components on a single axis, and `wheels`
draws gear pairs.
"""
