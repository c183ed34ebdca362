"""Writers of cases and results: a module for each format. Writers do not calculate anything.

>>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
>>> from vstatics.core.statics.solve import solve
>>> from vstatics.core.writers import listing, named, result_json
>>> case = Transmission(2, [], [Mechanism(1, 2, 0, ratio=-2.5)], [Gear()])
>>> listing.write(solve(case)).splitlines()[-2:], result_json.document(solve(case))["ratio"]
(['LOCKED(J),J=1,NP:', '  0'], [-2.5])
>>> named.mapping(case)["mechanisms"]
{'D1': {'first': 1, 'second': 2, 'ratio': -2.5}}
"""
