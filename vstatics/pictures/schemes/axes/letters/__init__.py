"""Letters of several axes.

`labels` are those of devices, `link_names` those of links; `obstacles` are what they keep clear
of, `extent` is how far they reach.
"""
