"""Texts in a stick diagram of several axes, and their positions.

`labels` places names of components, `link_names` places names of links, `obstacles` lists areas
that letters should not cover, and `extent` returns the total size.
"""
