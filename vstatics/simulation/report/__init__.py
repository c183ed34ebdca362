"""Sections of a page on a run of a scenario.

`motion` shows events, energies and pictures of a run. `runs` has the run that moves in a served
page: panels, levers and the stick diagram at a time.
"""
