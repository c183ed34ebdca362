"""Errors of rejected inputs."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TypeVar

import pytest

Error = TypeVar("Error", bound=BaseException)


@contextmanager
def rejects(
    errors: type[Error] | tuple[type[Error], ...], *words: str
) -> Iterator[pytest.ExceptionInfo[Error]]:
    """Check that an error is raised whose text contains all `words`."""
    with pytest.raises(errors) as caught:
        yield caught
    assert [word for word in words if word not in str(caught.value)] == []
