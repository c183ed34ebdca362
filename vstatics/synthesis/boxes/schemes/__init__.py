"""The schemes of boxes, as they are searched: part by part, none listed before it is needed.

`choices` has what a scheme leaves open: meshed sets, a held link, ports. They grow from `stems`,
or are put together of `parts` that have no link in common. `speeds` are what sets tell alone.
"""
