from __future__ import annotations

import pytest

from mrlab_ros.core.bucket import Bucket

pytestmark = pytest.mark.fast


def test_a_bucket_gives_its_burst_then_its_rate() -> None:
    bucket = Bucket(rate=2.0, burst=3.0)
    assert [bucket.take(1, 10.0) for _ in range(4)] == [True, True, True, False]
    assert bucket.take(1, 10.5)
    assert not bucket.take(1, 10.5)
    assert bucket.take(3, 100.0)
    assert not bucket.take(1, 100.0)
