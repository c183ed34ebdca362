"""Named tuples that start quickly, compared with those of the standard library."""

import pickle
import typing

from vstatics.core.start import NamedTuple


class Ours(NamedTuple):
    """Field with and without default."""

    number: "float"
    names: "tuple[str, ...]" = ()
    """Names."""

    @property
    def length(self) -> int:
        """Number of names."""
        return len(self.names)


class Theirs(typing.NamedTuple):
    """Field with and without default."""

    number: "float"
    names: "tuple[str, ...]" = ()
    """Names."""

    @property
    def length(self) -> int:
        """Number of names."""
        return len(self.names)


def test_named_tuples_agree_with_the_standard_library() -> None:
    assert vars(Ours).keys() - {"__orig_bases__"} == vars(Theirs).keys() - {"__orig_bases__"}
    for name in ("_fields", "_field_defaults", "__doc__", "__module__", "__mro__"):
        ours, theirs = getattr(Ours, name), getattr(Theirs, name)
        assert ours[1:] == theirs[1:] if name == "__mro__" else ours == theirs
    assert typing.get_type_hints(Ours) == typing.get_type_hints(Theirs)
    assert pickle.loads(pickle.dumps(Ours(2.0, ("a",)))).length == 1  # noqa: S301
