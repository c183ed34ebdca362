"""Random vibration of a gear under a torque or motion of a link that is given by its spectrum.

`spectra` has the spectra, and `spectrum_file` reads them. `excited` writes the gear with its input
as a first-order system, and `variances` calculates variances of the motion. `random_vibration`
returns results by the names of the case, and `tables` has the tables.
"""
