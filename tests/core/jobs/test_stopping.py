"""Signals that end a process: none is lost."""

import signal
import time

import pytest

from vstatics.core.jobs.stopping import StoppedError, stoppable


class _Finalised:
    def __del__(self) -> None:
        signal.raise_signal(signal.SIGINT)


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="a system without timers")
def test_a_signal_in_a_finaliser_whose_errors_python_drops_stops_the_block_later() -> None:
    def work() -> None:
        with stoppable():
            _Finalised()
            time.sleep(10)

    with pytest.raises(StoppedError):
        work()
