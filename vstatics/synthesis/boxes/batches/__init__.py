"""Search for gearboxes in pieces, and an estimate of time and results.

`ports` searches one scheme for any input and output, with the `arrays` of the compiled search.
`cut` divides the schemes into pieces, `found` searches a piece, and `work` defines the jobs of the
workers and stores finished pieces. A sample of the ports is `tried` beforehand, for the size of
the pieces and for the `estimate`.
"""
