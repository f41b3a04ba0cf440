from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrlab_ros.gateway.link.queues import Newest

pytestmark = pytest.mark.fast
OFFERS = st.lists(st.tuples(st.integers(0, 9), st.binary(min_size=1, max_size=30)))


@given(OFFERS, st.integers(1, 100))
def test_of_each_topic_the_newest_is_taken_once(
    offers: list[tuple[int, bytes]], limit: int
) -> None:
    newest = Newest()
    for topic, entry in offers:
        newest.offer(topic, 1 + topic % 7, entry)
    expected = dict(offers)
    assert len(newest) == len(expected)
    taken = []
    while newest:
        batch = newest.take(limit)
        assert batch
        assert len(batch) == 1 or sum(map(len, batch)) <= limit
        taken += batch
    assert sorted(taken) == sorted(expected.values())
    assert newest.take(limit) == []


def test_the_most_urgent_goes_first_and_the_rest_waits() -> None:
    newest = Newest()
    newest.offer(1, 5, b"late")
    newest.offer(2, 1, b"soon")
    newest.offer(3, 5, b"last")
    assert newest.take(4) == [b"soon"]
    assert newest.take(8) == [b"late", b"last"]


def test_a_topic_that_is_replaced_keeps_its_place() -> None:
    newest = Newest()
    newest.offer(1, 2, b"a1")
    newest.offer(2, 2, b"b1")
    newest.offer(1, 2, b"a2")
    assert newest.replaced == 1
    assert newest.take(2) == [b"a2"]
    newest.forget(2)
    assert not newest
