"""The same case in motion: what happens to it by a scenario."""
