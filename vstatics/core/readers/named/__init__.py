"""Cases in YAML and JSON: text -> nodes -> values by the declared shape -> `Transmission`.

`yaml_nodes` and `json_nodes` convert a text to `nodes` with their places. `walk` reads the nodes
along the shape declared in `vstatics.core.model.keys`. `leaves` reads single values and replaces
unreadable values by stand-ins, `compounds` reads entries of mappings, rows and points, and
`references` resolves names of links and shift elements. `scalars` and `arithmetic` read numbers,
whose units are in `units` (speed, torque, power) or `si_units` (other quantities). `joined_links`
collects the links of a case without a list of links, and `drawing` reads gear sets. `headings` and
`csv_rows` read tables of numbers in files. `arguments` builds the arguments of `Transmission`, and
`reader` runs all steps. `schema` generates the JSON Schema of the same shape, and `node_numbers`
finds numbers by paths.
"""
