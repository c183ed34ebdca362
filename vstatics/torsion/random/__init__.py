"""Random vibration of a gear: torques on a link, or its motion, by their spectrum.

`spectra` are what excites, `spectrum_file` reads them. `excited` is the gear with one input as a
first order system, `variances` has what its motion comes to on the average, `random_vibration`
tells it by the names of the case; `tables` has the tables.
"""
