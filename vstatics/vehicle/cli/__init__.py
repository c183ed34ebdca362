"""Commands `vstatics cycle` and `vstatics damage`, and options shared with other commands.

`cycle` drives a vehicle through a driving cycle, and `damage` contains the commands on fatigue
life. `duty` declares the options of duty cycles, and `strengths` rejects cases without fatigue
strengths.
"""
