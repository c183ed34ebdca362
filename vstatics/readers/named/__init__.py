"""YAML and JSON: text -> nodes -> walk along the declared shape -> Transmission."""
