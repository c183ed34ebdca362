"""Pictures of a run over time.

`lines` declares lines and the panels that contain them; `panels` selects them for a run. `elements`
finds the times at which each shift element sticks or slips, `gears` the gear at each time, and
`events` places the words of events. `rows` draws the bars above the panels, `line_panel` draws a
panel, `shift` draws the pages, and `plotting` is the function for Python users.
"""
