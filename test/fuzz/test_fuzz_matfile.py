"""A bounded run of the fuzz target; the long one is by hand."""

import fuzz_matfile
import pytest

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(("name", "data"), fuzz_matfile.seeds())
def test_the_seeds_are_read(name, data):
    assert fuzz_matfile.one(data, name)


def test_two_thousand_mutations_are_read_or_refused():
    taken, refused = fuzz_matfile.bounded(2000, seed=7)
    assert taken + refused == 2000
    assert refused > 200
