"""What stands one behind the other before a box and behind it: shafts, dampers, reductions."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import replace
from typing import NamedTuple

from vstatics.pictures.schemes.scheme import Scheme, SchemePort, SchemeState


class CoaxialChain(NamedTuple):
    """Couplings of two links each, from left to right."""

    links: Sequence[int]
    """One more than there are devices."""
    devices: Sequence[int]
    """By their places in the scheme."""
    is_before: bool
    """Whether it is at the input of the box."""
    ports: tuple[SchemePort, SchemePort]
    """At its ends; those by which it goes on, too."""

    def part(self, first: int, last: int) -> CoaxialChain:
        """Some of its devices, by their places in it; `last` is not among them."""
        links, devices = self.links[first : last + 1], self.devices[first:last]
        left = SchemePort(links[0], "before") if first else self.ports[0]
        right = SchemePort(links[-1], "behind") if last < len(self.devices) else self.ports[1]
        return CoaxialChain(links, devices, self.is_before, (left, right))

    def broken(self, wide: Callable[[CoaxialChain], float], room: float) -> Iterator[CoaxialChain]:
        """Parts that are no wider than a room, if one device is not [pt]."""
        first = 0
        for last in range(1, len(self.devices) + 1):
            if last == len(self.devices) or wide(self.part(first, last + 1)) > room:
                yield self.part(first, last)
                first = last


class ChainedScheme(NamedTuple):
    """A scheme without what stands before it and behind it."""

    scheme: Scheme
    """With all devices, but with ports where chains go on."""
    chains: Sequence[CoaxialChain]

    @property
    def left_out(self) -> set[int]:
        """Devices of chains."""
        return {index for chain in self.chains for index in chain.devices}


def unchained(scheme: Scheme, others: Container[int]) -> ChainedScheme:
    """A scheme of which chains at input and output are taken off.

    Parameters
    ----------
    others : container of int
        Devices that are in no chain: sets.

    Examples
    --------
    >>> from vstatics.pictures.schemes.scheme import Device
    >>> damper = Device("damper", "spring", {"first": 1, "second": 2}, (0,))
    >>> devices = [damper, Device("P", "mechanism", {"first": 2, "second": 3, "third": 4}, (0,))]
    >>> ports = [SchemePort(1, "input"), SchemePort(4, "output")]
    >>> found = unchained(Scheme(["engine", "sun", "ring", "carrier"], devices, ports), {1})
    >>> found.chains[0].links, [(port.link, port.role) for port in found.scheme.ports]
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
            outputs = [one for one in scheme.ports if one.link == inner.link]
            last = outputs[0] if outputs and not goes_on else inner
            ends = (port, last) if is_before else (last, port)
            chains.append(CoaxialChain(links, devices, is_before, ends))
            ports[place] = SchemePort(inner.link, "before" if is_before else "behind")
    return ChainedScheme(replace(scheme, ports=ports), chains)


def _walk(
    scheme: Scheme, start: int, others: Container[int], taken: AbstractSet[int]
) -> tuple[list[int], list[int]]:
    """Links and devices from a port, as long as one device goes on."""
    ends = {port.link for port in scheme.ports} - {start}
    links, devices = [start], list[int]()
    while links[-1] not in ends:
        own = [
            index
            for index, device in enumerate(scheme.devices)
            if links[-1] in device.links and index not in devices and index not in taken
        ]
        if len(own) != 1 or own[0] in others or len(scheme.devices[own[0]].links) != 2:
            break
        devices.append(own[0])
        links += scheme.devices[own[0]].links - {links[-1]}
    return links, devices


def chained_state(state: SchemeState, chains: Sequence[CoaxialChain]) -> SchemeState:
    """A state that says, too, whether torque passes from row to row."""
    idle = set(state.idle_ports)
    for chain in chains:
        for port, nearest in zip(chain.ports, (chain.devices[0], chain.devices[-1]), strict=True):
            if port.is_further and state.loaded is not None and not state.loaded[nearest]:
                idle |= {SchemePort(port.link, role) for role in ("before", "behind")}
    return replace(state, idle_ports=idle)
