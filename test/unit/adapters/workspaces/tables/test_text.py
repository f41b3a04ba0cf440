"""Tables as spreadsheets, loggers and LabVIEW write them."""

from contextlib import contextmanager
from datetime import datetime, timedelta

import numpy as np
import pytest

from mrlab_ros.adapters.workspaces.diagnostics import (
    COMMAS_TWICE,
    EMPTY_CELLS,
    LABVIEW_SEGMENTS,
    LINES_DIFFER,
    TWO_DATES,
    UNITS_UNKNOWN,
    WRONG_CELL,
)
from mrlab_ros.adapters.workspaces.matlab.elements import NotATable
from mrlab_ros.adapters.workspaces.tables.cells import is_instant, seconds
from mrlab_ros.adapters.workspaces.tables.text import parsed

TABLE = np.column_stack([np.arange(5) * 0.02, np.linspace(-1, 1, 5), np.linspace(0, 0.5, 5)])
HEADINGS = ("t", "q1", "q2")


@contextmanager
def no_table(code, **values):
    """Expect that a text is no table, for this reason."""
    with pytest.raises(NotATable) as caught:
        yield
    (why,) = caught.value.args
    assert why.code == code.code
    assert values.items() <= why.values.items()


def lines(separator=",", decimal=".", quote="", table=TABLE):
    return [
        separator.join(quote + f"{x:.5f}".replace(".", decimal) + quote for x in row)
        for row in table
    ]


def read(*parts):
    return parsed("\n".join(parts).encode())


@pytest.mark.parametrize(
    ("separator", "decimal", "quote"),
    [(",", ".", ""), (";", ",", ""), ("\t", ",", ""), (" ", ",", ""), (",", ",", '"')],
)
def test_numbers_are_read_whatever_separates_them(separator, decimal, quote):
    found = read(separator.join(HEADINGS), *lines(separator, decimal, quote))
    np.testing.assert_allclose(found.values, TABLE)
    assert found.headings == HEADINGS


@pytest.mark.parametrize("heading", ["t,q1,q2", ""])
def test_commas_for_decimals_and_columns_at_once_are_refused(heading):
    with no_table(COMMAS_TWICE):
        read(*filter(None, [heading]), *lines(",", ","))


def test_whole_numbers_between_commas_are_columns():
    found = read("a,b,c,d", *(f"{i},{i + 1},{i * 7},{i % 3}" for i in range(30)))
    assert found.values.shape == (30, 4)


def test_units_under_the_headings_stand_in_brackets():
    found = read("t,q1,q2", "s,rad,rad/s", *lines())
    assert found.headings == ("t", "q1 [rad]", "q2 [rad/s]")
    with no_table(UNITS_UNKNOWN, found="bar"):
        read("t,q1,q2", "s,rad,bar", *lines())


def test_lines_above_a_table_are_skipped_and_their_numbers_kept():
    found = read("Logger 3000", "Sample Rate [Hz];50", "", ";".join(HEADINGS), *lines(";"))
    np.testing.assert_allclose(found.values, TABLE)
    assert found.headings == HEADINGS
    assert found.stated == {"Sample_Rate": 50.0}
    assert read("# fs = 50", "# made by me", *lines()).stated == {"fs": 50.0}


def test_a_row_that_is_cut_off_is_no_line_above():
    with no_table(LINES_DIFFER, line=2):
        read(*lines()[:1], "0.1,0.2", *lines()[1:])
    with no_table(WRONG_CELL, line=5, found="x"):
        read(",".join(HEADINGS), *lines()[:3], "0,x,0", *lines()[3:])


@pytest.mark.parametrize("error", ["#NV", "#N/A", "#DIV/0!", "#WERT!", "#NAME?"])
@pytest.mark.parametrize("separator", [";", ",", "\t"])
def test_a_row_of_a_sheet_without_values_is_refused_and_no_comment(error, separator):
    wrong = separator.join([error] * 3)
    with no_table(WRONG_CELL, line=4, found=error):
        read(separator.join(HEADINGS), *lines(separator)[:2], wrong, *lines(separator)[2:])


@pytest.mark.parametrize("comment", ["# paused", "# Note, of Bob", "#NOTE: slower"])
def test_a_comment_between_rows_is_none(comment):
    np.testing.assert_allclose(read(*lines()[:2], comment, *lines()[2:]).values, TABLE)


@pytest.mark.parametrize(("separator", "decimal"), [(";", ","), (",", "."), ("\t", ".")])
def test_rows_of_empty_cells_below_a_table_are_none(separator, decimal):
    empty = separator * 2
    found = read(separator.join(HEADINGS), *lines(separator, decimal), empty, empty, "", empty)
    np.testing.assert_allclose(found.values, TABLE)
    assert found.headings == HEADINGS


def test_a_row_of_empty_cells_within_a_table_is_named():
    with no_table(EMPTY_CELLS, line=4):
        read(",".join(HEADINGS), *lines()[:2], ",,", *lines()[2:])


LABVIEW = """LabVIEW Measurement\t
Writer_Version\t2
Separator\tTab
Decimal_Separator\t.
X_Columns\tOne
***End_of_Header***\t
\t
Channels\t2
Samples\t5\t5
Y_Unit_Label\trad\trad
Delta_X\t0.02\t0.02
***End_of_Header***\t\t
X_Value\tq1\tq2\tComment"""


@pytest.mark.parametrize("comment", ["", "\t", "\tbegin"])
def test_a_measurement_of_labview_is_read(comment):
    found = parsed(
        "\r\n".join([*LABVIEW.split("\n"), *(x + comment for x in lines("\t"))]).encode()
    )
    np.testing.assert_allclose(found.values, TABLE)
    assert found.headings == ("t", "q1 [rad]", "q2 [rad]")
    assert found.stated == {"dt": 0.02}


def test_several_segments_of_labview_are_refused():
    more = [*LABVIEW.split("\n"), *lines("\t"), "***End_of_Header***", *lines("\t")]
    with no_table(LABVIEW_SEGMENTS):
        read(*more)


FORMATS = ("%Y-%m-%dT%H:%M:%S.%f", "%Y-%m-%d %H:%M:%S.%f", "%d.%m.%Y %H:%M:%S,%f", "%H:%M:%S.%f")


@pytest.mark.parametrize("form", [*FORMATS, "%d-%b-%Y %H:%M:%S.%f", "%Y-%m-%dT%H:%M:%S.%fZ"])
@pytest.mark.parametrize("heading", ["time;q1;q2", ""])
def test_dates_and_times_of_day_become_seconds(form, heading):
    start = datetime(2024, 2, 28, 23, 59, 59, 960_000)  # midnight comes after two rows
    rows = [
        ";".join([(start + timedelta(seconds=row[0])).strftime(form), f"{row[1]}", f"{row[2]}"])
        for row in TABLE
    ]
    found = read(*filter(None, [heading]), *rows)
    assert found.instants == 0
    np.testing.assert_allclose(found.values, TABLE, atol=1e-9)


def test_a_date_and_a_time_between_blanks_are_one_cell():
    found = read("2024-05-03 10:00:00.00 0.1 0.2", "2024-05-03 10:00:00.02 0.1 0.3")
    np.testing.assert_allclose(found.values, [[0, 0.1, 0.2], [0.02, 0.1, 0.3]], atol=1e-9)


def test_what_is_no_date_is_named_with_its_line():
    with no_table(WRONG_CELL, line=3, found="later", expected="date"):
        read("time;q1", "10:00:00;1", "later;2")
    with no_table(TWO_DATES, count=2):
        read("a;b;q", "10:00:00;11:00:00;1", "10:00:01;11:00:01;1")


def test_instants():
    assert not is_instant("1.5")
    assert not is_instant("12")
    assert seconds(["05/03/2024 10:00:00", "05/03/2024 10:00:01"]) == [0.0, 1.0]
    assert seconds(["12/31/2024 23:59:59", "01/01/2025 00:00:00"]) == [0.0, 1.0]
    assert seconds(["10:00:00", "x"]) == [0.0, None]


def test_a_clock_of_twelve_hours_passes_noon_and_midnight():
    noon = ["11:59:59.5 AM", "12:00:00 PM", "1:00:00 p.m."]
    assert seconds(noon) == [0.0, 0.5, 3600.5]
    night = ["03/05/2024 11:59:59 PM", "03/06/2024 12:00:01 AM"]
    assert seconds(night) == [0.0, 2.0]
