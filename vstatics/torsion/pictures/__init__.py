"""Pictures of natural modes, resonances and responses.

`shown_modes` calculates the modes to draw. `shapes` draws modes over the links, and `orders` draws
Campbell diagrams and responses over the speed. `dump` draws the torques of a clutch dump.
"""
