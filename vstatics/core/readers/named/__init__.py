"""Cases in YAML and JSON: text -> nodes -> values -> `Transmission`.

`yaml_nodes` and `json_nodes` parse a text to a tree of `nodes` with their places. A shape, declared
in `vstatics.core.model.keys`, describes the permitted keys and values. `walk` reads the nodes by
the shape: `leaves` reads single values (a stand-in replaces an unreadable value), `compounds` reads
entries of mappings, rows and points, and `references` finds the numbers of named links and shift
elements. Single values are `scalars`: numbers with `arithmetic` and a unit, from `units` (common
units of speed, torque, power) or `si_units`. `joined_links` collects the links of a case without a
list of links, and `drawing` reads gear sets. `headings` and `csv_rows` read tables of numbers in
files. `arguments` builds the arguments of `Transmission`, and `reader` runs all steps. `schema`
generates the JSON Schema from the shape, and `node_numbers` finds numbers by paths.
"""
