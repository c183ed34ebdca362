"""Drawing of half-sections.

`lines` calculates the lines of links, `links` draws them with names, `devices` draws gear sets and
shift elements, `ports` the arrows of input and output, and `chain` a row of components in series.
"""
