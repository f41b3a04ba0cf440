"""What a machine lacks is told by the error that it raises, and by nothing else."""

import errno
import os

import pytest

from mrlab_ros.core.base.machine import NUMBERS, Lack, lack, lacking


@pytest.mark.parametrize("number", NUMBERS)
def test_an_error_of_the_system_names_what_is_lacking(number):
    found = lacking(OSError(number, os.strerror(number)))
    assert found is not None
    assert (found.code, found.values) == ("machine_lacks", {"lack": NUMBERS[number].value})


def test_memory_is_lacking_however_that_is_said():
    assert lack(MemoryError()) is lack(OSError(errno.ENOMEM, "")) is Lack.MEMORY


@pytest.mark.parametrize(
    "error", [OSError(errno.ENOENT, ""), OSError("of no number"), ValueError()]
)
def test_other_errors_have_other_causes(error):
    assert lack(error) is lacking(error) is None


def test_what_is_short_for_one_process_is_not_short_for_all():
    assert [each for each in Lack if each.is_room] == [Lack.DISK, Lack.QUOTA]
    assert not Lack.DESCRIPTORS.is_shared
    assert Lack.FILES.is_shared
