"""The run of a scenario over time.

`lines` says which lines a picture has and when elements stick or slip, `events` what happens and
which of it is named; `shift` draws the panels of states, speeds, slips, torques and heat.
"""
