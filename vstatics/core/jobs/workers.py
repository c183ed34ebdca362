"""Choice of the workers: this process, several processes, or a Dask cluster."""

from __future__ import annotations

import os

from vstatics.core.jobs.alone import Alone, Describe, Rules, Workers


def cores() -> int:
    """Return the number of available cores."""
    usable = getattr(os, "sched_getaffinity", None)
    return len(usable(0)) if usable else os.cpu_count() or 1


def workers(
    state: object,
    describe: Describe,
    *,
    jobs: int = 1,
    scheduler: str | None = None,
    rules: Rules = Rules(),  # noqa: B008 (it cannot be changed)
) -> Workers:
    """Return the workers: a cluster if a scheduler is given, otherwise processes.

    Parameters
    ----------
    state, describe
        Arguments of `Workers`, which must be picklable.
    jobs : int
        Number of processes. With 1, the present process does all the work.
    scheduler : str, optional
        Address of a Dask scheduler.
    rules : Rules
        Rules for several processes on this machine.
    """
    if scheduler is not None:
        from vstatics.core.jobs.cluster import Cluster

        return Cluster(state, describe, scheduler)
    if jobs > 1:
        from vstatics.core.jobs.processes import Processes

        return Processes(state, describe, jobs, rules)
    return Alone(state, describe)
