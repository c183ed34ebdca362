"""Drawing of half-sections with the ink of all schemes.

`lines` are the lines of links, `links` their names and the axis, `devices` the symbols of sets and
shift elements, `ports` the arrows of input and output; `chain` draws a row of couplings.
"""
