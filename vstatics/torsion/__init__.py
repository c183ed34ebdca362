"""The transmission as a torsional system: masses, springs, natural frequencies."""
