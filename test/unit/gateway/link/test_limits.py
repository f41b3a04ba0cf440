from __future__ import annotations

import pytest

from mrlab_ros.gateway.link.limits import Credit, ahead

pytestmark = pytest.mark.fast


def test_a_client_says_up_to_which_batch() -> None:
    credit = Credit(8)
    assert not credit.left
    credit.grant(2)
    assert [credit.take(), credit.take()] == [1, 2]
    assert not credit.left
    credit.grant(3)
    credit.grant(2)
    assert credit.left == 1


def test_no_client_gets_more_at_once_than_the_largest() -> None:
    credit = Credit(8)
    credit.grant(1_000_000)
    assert credit.left == 8


@pytest.mark.parametrize(
    ("number", "of", "expected"),
    [(5, 3, 2), (3, 5, -2), (1, 2**32 - 1, 2), (2**32 - 1, 1, -2), (7, 7, 0)],
)
def test_numbers_begin_anew_after_32_bits(number: int, of: int, expected: int) -> None:
    assert ahead(number, of) == expected
