"""Who does the items: this process, several processes, or a Dask cluster."""

from __future__ import annotations

import os

from vstatics.core.jobs.alone import Alone, Describe, Rules, Workers


def cores() -> int:
    """Cores that this process may use."""
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
    """The workers: a cluster if there is a scheduler, else so many processes.

    Parameters
    ----------
    state, describe
        See `Workers`; both can be pickled.
    jobs : int
        Processes; with 1 this process does everything itself.
    scheduler : str, optional
        Address of a Dask scheduler.
    rules : Rules
        For several processes of this machine.
    """
    if scheduler is not None:
        from vstatics.core.jobs.cluster import Cluster

        return Cluster(state, describe, scheduler)
    if jobs > 1:
        from vstatics.core.jobs.processes import Processes

        return Processes(state, describe, jobs, rules)
    return Alone(state, describe)
