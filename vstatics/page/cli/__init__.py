"""Commands `vstatics report` and `vstatics serve`.

`report` writes the page of a case, of two cases, or of gearboxes listed by `synth box`. `serve`
serves the page of a case until it is stopped.
"""
