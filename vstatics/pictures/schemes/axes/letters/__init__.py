"""Texts in a diagram of several axes, and their positions.

`labels` places names of components, `link_names` places names of links, `obstacles` lists areas
without letters, and `extent` is the total size.
"""
