"""A run that moves within its page: panels that are zoomed, a time that moves levers and stick.

`instants` chooses those that the page carries, `record` has the run as plain data, `levers` the
levers that move, `section` all of it as HTML. `scripts` are that which moves it, and uPlot, which
draws panels.
"""
