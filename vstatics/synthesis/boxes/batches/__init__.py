"""Search for gearboxes in pieces, and estimates of its time and results.

`ports` searches a scheme with each choice of ports (input and output link), with the `arrays` of
the compiled search. `cut` divides all schemes into pieces, `found` searches a piece, and `work`
defines the jobs of the workers and stores finished pieces. Before the search, `tried` examines a
sample of ports; its work determines the number of pieces and the `estimate`.
"""
