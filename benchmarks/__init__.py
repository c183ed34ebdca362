"""Benchmarks: the table of docs/performance.md, each row a ratio to a peer (``make bench``).

`rows` declares the table. The functions that it names prepare a calculation and its peer: `gears`
(also sweeps, files and pictures), `torsion`, `motions` and `boxes`. `measuring` runs both
alternately. Peers with a module of their own are `peer` (the method in C, `peer.c`), `smoothed`
and `driveline` (motions by `scipy.integrate.solve_ivp`).
"""
