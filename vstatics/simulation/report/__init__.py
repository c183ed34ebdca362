"""Sections about a run of a scenario, in an HTML report.

`motion` shows events, energies and pictures of a run, `pair` two runs side by side. `runs` contains
the interactive run of a served page: panels, levers and the stick diagram at a selected time.
"""
