"""Interactive run on a page: panels with zoom, and levers and stick diagram at a selected time.

`instants` chooses the instants that the page contains, `record` writes the run as JSON data,
`levers` draws the levers, and `section` writes the HTML. `scripts` loads the JavaScript, including
uPlot, which draws the panels.
"""
