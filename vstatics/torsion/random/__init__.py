"""Random vibration of a gear under a random torque on a link, or a random motion of the link.

`spectra` declares spectra of this torque or motion, and `spectrum_file` reads them. `excited`
writes the gear with its input as a first-order system, and `variances` calculates variances of the
motion. `random_vibration` returns results by names of links and components, and `tables` returns
the tables.
"""
