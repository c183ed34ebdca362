"""Half-sections on paper, drawn with the ink of all schemes.

`lines` are the wires of links, `links` their names and the axis, `devices` the signs of sets and
shift elements, `ports` the arrows of input and output; `chain` is what stands one behind the
other.
"""
