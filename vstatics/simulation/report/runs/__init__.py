"""Interactive run on a page: panels with zoom, and a selected time for levers and stick diagram.

`instants` chooses the instants that the page contains, `record` writes the run as JSON data,
`levers` draws the levers, `section` writes the HTML. `scripts` loads the JavaScript, including
uPlot, which draws the panels.
"""
