"""The commands `vstatics cycle` and `vstatics damage`, and options that others share with them.

`cycle` drives a case through a cycle of speeds, `damage` is the group of commands on life. `duty`
has the options of duty cycles, `strengths` refuses cases without fatigue strengths.
"""
