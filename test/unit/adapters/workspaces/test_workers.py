"""A worker that was begun is the next reader's, once."""

from __future__ import annotations

import subprocess
import sys

from mrlab_ros.adapters.workspaces import workers


def test_the_next_reader_takes_the_worker_that_was_begun() -> None:
    workers.begin()
    begun = workers.take()
    try:
        assert begun.pid is not None
        assert begun.warm()
        assert begun.warm() == b""
        assert workers.take().pid is None
    finally:
        begun.stop()


def test_a_worker_is_begun_without_numpy() -> None:
    script = (
        "import sys; from mrlab_ros.adapters.workspaces import workers; "
        "sys.exit('numpy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 0
