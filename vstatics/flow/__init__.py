"""Where the power goes in a gear."""
