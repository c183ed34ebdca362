"""A page whose numbers change: `numbers` says of each of them what it is."""
