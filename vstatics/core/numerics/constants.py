"""Physical constants."""

GRAVITY = 9.81
"""Acceleration of gravity. [m/s^2]"""
AIR = 1.2
"""Density of air. [kg/m^3]"""
