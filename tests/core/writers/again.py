"""Whether a case that is written is the same when it is read."""

from vstatics import Transmission, loads
from vstatics.core.writers.named import write_json, write_yaml


def is_read_again(case: Transmission) -> bool:
    """Return whether YAML and JSON of a case, told apart by their content, give the same case."""
    return loads(write_yaml(case)) == loads(write_json(case)) == case
