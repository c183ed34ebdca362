"""The run of a scenario over time.

`elements` says when each sticks or slips, `gears` which gear holds when, `panels` which lines there
are; `lines` is what a line and a panel are, `events` how and where what happens is named. `rows`
draws the bars over the panels, `line_panel` a panel, `shift` the pages.
"""
