"""How a transmission is joined: boxes and wires, or the stick diagram of its elements."""
