"""`vstatics compare`: `pairs` reads what is held against what, `command` tells the outcome."""
