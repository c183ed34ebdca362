"""YAML and JSON: text -> nodes -> walk along the declared shape -> Transmission.

`yaml_nodes` and `json_nodes` turn a text into `nodes` with their places. `walk` goes through
them along the shape that `vstatics.core.model.keys` declares: `leaves` says how a single value is
read, and what stands in for one that cannot be; `compounds` reads entries of mappings, rows
and points; `references` knows the names of links and shift elements. Single values are
`scalars`, with `arithmetic` before them and a unit behind: of the trade in `units`, of SI in
`si_units`. `joined_links` gathers the links of a case that lists none, `drawing` makes those of
drawn elements. `headings` and `csv_rows` read tables of numbers in files. `arguments` has what
`Transmission` takes, `reader` does all this in order.
`schema` makes the JSON Schema of the same shape, `node_numbers` finds numbers by paths.
"""
