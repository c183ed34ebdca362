"""Sections of a page on torsional vibration.

`vibration` calculates the modes of all gears of a case for its page and shows them: natural
frequencies, shapes, damping, the Campbell diagram.
"""
