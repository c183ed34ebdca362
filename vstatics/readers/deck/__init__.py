"""The Visual-Statics deck: bytes -> text -> fields -> values -> Transmission."""
