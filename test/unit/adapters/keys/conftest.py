"""A keys folder for the tests beside this file."""

from datetime import datetime, timezone

import pytest

from mrlab_ros.adapters.keys.folder import Keys
from mrlab_ros.core.bridge.access import Login

NOW = datetime(2026, 9, 1, 8, tzinfo=timezone.utc)


@pytest.fixture
def keys(tmp_path):
    return Keys.create(tmp_path / "keys", ["lab.example.org", "192.168.1.20"], Login.BOTH, NOW)
