"""Pictures of a run over time.

`elements` finds the times at which each shift element sticks or slips, `gears` the gear at each
time, `panels` the lines to draw. `lines` declares lines and panels, `events` places the words of
events. `rows` draws the bars above the panels, `line_panel` a panel, `shift` the pages.
"""
