"""Cases in YAML and JSON: text -> nodes -> values by the declared shape -> `Transmission`.

`yaml_nodes` and `json_nodes` turn a text into `nodes` with their places. `walk` reads the nodes
along the shape declared in `vstatics.core.model.keys`: `leaves` reads single values and gives their
stand-ins, `compounds` reads entries of mappings, rows and points, and `references` resolves the
names of links and shift elements. Single values are `scalars`: numbers with `arithmetic` and a
unit, of the trade in `units` or of SI in `si_units`. `joined_links` collects the links of a case
without a list of links, and `drawing` reads gear sets. `headings` and `csv_rows` read tables of
numbers in files. `arguments` builds the arguments of `Transmission`, and `reader` runs all steps.
`schema` generates the JSON Schema of the same shape, and `node_numbers` finds numbers by paths.
"""
