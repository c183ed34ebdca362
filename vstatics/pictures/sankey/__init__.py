"""The power flow of each gear as bands from input to output."""
