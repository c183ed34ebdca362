"""Pictures of natural modes, resonances and responses.

`shown_modes` calculates the modes to draw. `shapes` draws mode shapes over the links, `orders`
draws Campbell diagrams and responses over the speed, and `dump` draws the torques of a clutch dump.
"""
