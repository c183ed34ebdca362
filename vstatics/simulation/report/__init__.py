"""Sections about a run of a scenario, in an HTML report.

`motion` shows events, energies and pictures of a run, and `pair` shows two runs side by side.
`runs` is the interactive run of a page in a browser: panels, levers and the stick diagram at a
selected time.
"""
