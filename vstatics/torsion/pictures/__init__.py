"""Natural modes and frequencies, and what excites them.

`shown_modes` takes the modes of a gear or tells why there are none. `shapes` draws them over the
links, `orders` where orders of a speed meet their frequencies, and the response. `dump` is the
picture of a clutch that is dumped.
"""
