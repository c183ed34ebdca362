"""Chains of shafts, dampers and reductions before and after a gearbox, drawn as separate rows."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import replace
from typing import NamedTuple

from vstatics.pictures.schemes.scheme import Scheme, SchemePort, SchemeState


class CoaxialChain(NamedTuple):
    """Components in series, each with two links, from left to right."""

    links: Sequence[int]
    """Numbers of the links of the chain, including both ends."""
    devices: Sequence[int]
    """Indices of the components in the scheme."""
    is_before: bool
    """True for the chain at the input of the gearbox, False at the output."""
    ports: tuple[SchemePort, SchemePort]
    """Ports at the left and right end. A port can be the continuation in a further row."""

    def part(self, first: int, last: int) -> CoaxialChain:
        """Return the part of the chain from component `first` up to, but without, `last`."""
        links, devices = self.links[first : last + 1], self.devices[first:last]
        left = SchemePort(links[0], "before") if first else self.ports[0]
        right = SchemePort(links[-1], "behind") if last < len(self.devices) else self.ports[1]
        return CoaxialChain(links, devices, self.is_before, (left, right))

    def broken(self, wide: Callable[[CoaxialChain], float], room: float) -> Iterator[CoaxialChain]:
        """Yield parts that are no wider than `room` [pt], each with at least one component."""
        first = 0
        for last in range(1, len(self.devices) + 1):
            if last == len(self.devices) or wide(self.part(first, last + 1)) > room:
                yield self.part(first, last)
                first = last


class ChainedScheme(NamedTuple):
    """Scheme in which the chains at the input and output are separated from the gearbox."""

    scheme: Scheme
    """Scheme with all components, whose ports include the ends of the chains."""
    chains: Sequence[CoaxialChain]

    @property
    def left_out(self) -> set[int]:
        """Indices of the components in chains."""
        return {index for chain in self.chains for index in chain.devices}


def unchained(scheme: Scheme, others: Container[int]) -> ChainedScheme:
    """Separate the chains at input and output from a scheme.

    Parameters
    ----------
    others : container of int
        Indices of components that cannot be in a chain: gear sets.

    Examples
    --------
    >>> from vstatics.pictures.schemes.scheme import Device
    >>> damper = Device("damper", "spring", {"first": 1, "second": 2}, (0,))
    >>> devices = [damper, Device("P", "mechanism", {"first": 2, "second": 3, "third": 4}, (0,))]
    >>> ports = [SchemePort(1, "input"), SchemePort(4, "output")]
    >>> parts = unchained(Scheme(["engine", "sun", "ring", "carrier"], devices, ports), {1})
    >>> parts.chains[0].links, [(port.link, port.role) for port in parts.scheme.ports]
    ([1, 2], [(2, 'before'), (4, 'output')])
    """
    chains: list[CoaxialChain] = []
    ports, taken = list(scheme.ports), set[int]()
    for place, port in enumerate(scheme.ports):
        if port.role not in ("input", "output"):
            continue
        is_before = port.role == "input"
        links, devices = _walk(scheme, port.link, others, taken)
        if devices:
            taken.update(devices)
            way = 1 if is_before else -1
            links, devices = links[::way], devices[::way]
            inner = SchemePort(links[-1], "behind") if is_before else SchemePort(links[0], "before")
            goes_on = any(
                inner.link in device.links
                for index, device in enumerate(scheme.devices)
                if index not in taken
            )
            outputs = [other_port for other_port in scheme.ports if other_port.link == inner.link]
            last = outputs[0] if outputs and not goes_on else inner
            ends = (port, last) if is_before else (last, port)
            chains.append(CoaxialChain(links, devices, is_before, ends))
            ports[place] = SchemePort(inner.link, "before" if is_before else "behind")
    return ChainedScheme(replace(scheme, ports=ports), chains)


def _walk(
    scheme: Scheme, start: int, others: Container[int], taken: AbstractSet[int]
) -> tuple[list[int], list[int]]:
    """Return the links and components in series from a port to the first branch."""
    ends = {port.link for port in scheme.ports} - {start}
    links, devices = [start], list[int]()
    while links[-1] not in ends:
        next_devices = [
            index
            for index, device in enumerate(scheme.devices)
            if links[-1] in device.links and index not in devices and index not in taken
        ]
        if (
            len(next_devices) != 1
            or next_devices[0] in others
            or len(scheme.devices[next_devices[0]].links) != 2
        ):
            break
        devices.append(next_devices[0])
        links += scheme.devices[next_devices[0]].links - {links[-1]}
    return links, devices


def chained_state(state: SchemeState, chains: Sequence[CoaxialChain]) -> SchemeState:
    """Return a state in which ports between rows are unloaded if the next component is unloaded."""
    idle = set(state.idle_ports)
    for chain in chains:
        for port, nearest in zip(chain.ports, (chain.devices[0], chain.devices[-1]), strict=True):
            if port.is_further and state.loaded is not None and not state.loaded[nearest]:
                idle |= {SchemePort(port.link, role) for role in ("before", "behind")}
    return replace(state, idle_ports=idle)
