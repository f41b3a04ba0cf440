"""Orders to end a recording wait in files, whatever else is in their folder."""

from __future__ import annotations

from mrlab_ros.adapters.stop_orders import StopOrders


def test_an_order_waits_until_it_is_removed(tmp_path):
    assert StopOrders(str(tmp_path)).leave("/bags/class")
    (order,) = StopOrders(str(tmp_path)).waiting()
    assert order.bag == "/bags/class"
    StopOrders(str(tmp_path)).remove(order)
    assert StopOrders(str(tmp_path)).waiting() == []


def test_a_file_that_is_no_order_is_removed(tmp_path):
    orders = StopOrders(str(tmp_path))
    orders.leave("")
    for name, content in (("text", b"\xff{"), ("list", b"[]"), ("other", b"{}")):
        (tmp_path / "stop_orders" / name).write_bytes(content)
    assert [order.bag for order in orders.waiting()] == [""]
    assert len(list((tmp_path / "stop_orders").iterdir())) == 1


def test_without_a_folder_no_order_can_be_left(tmp_path):
    for orders in (StopOrders(""), StopOrders(str(tmp_path / "nowhere"))):
        assert not orders.leave("")
        assert orders.waiting() == []
