from __future__ import annotations

import asyncio
import gzip
import hashlib

import pytest

from mrlab_ros.core.bridge.assets import LARGEST_PIECE, Described
from mrlab_ros.gateway.assets.cache import FRESH_S, AssetCache, Changed
from mrlab_ros.gateway.errors import NotFound
from mrlab_ros.gateway.lab.connection import NoAnswer, Refused, Sample
from mrlab_ros.gateway.pages import Page

KEY = "assets/mrlab_ros/robots/ur5e/meshes/link.glb"
PATH = KEY.removeprefix("assets/")
SMALL = b"glTF" * 100
LARGE = bytes(range(256)) * (LARGEST_PIECE // 256 * 2) + b"end"


class Lab:
    """A lab with files by key; asked: the selectors of all queries."""

    def __init__(self, **files: bytes) -> None:
        self.files: dict[str, bytes] = {KEY: SMALL}
        self.asked: list[str] = []
        self.away: Exception | None = None
        self.answers = asyncio.Event()
        self.answers.set()

    async def get(self, selector: str, timeout_s: float = 5.0) -> Sample | None:
        self.asked.append(selector)
        await self.answers.wait()
        if self.away:
            raise self.away
        key, _, parameters = selector.partition("?")
        values = dict(each.split("=") for each in parameters.split(";"))
        if key not in self.files:
            raise Refused(f"there is no asset {key}")
        data = self.files[key]
        whole = Described(len(data), hashlib.sha256(data).hexdigest(), "model/gltf-binary")
        offset, length = int(values["offset"]), int(values["length"])
        piece = data[offset : offset + min(length, LARGEST_PIECE)]
        return Sample(key, piece, attachment=whole.attachment(offset))


@pytest.fixture
def lab():
    return Lab()


class Clock:
    now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def cache(lab, clock):
    return AssetCache(lab, now=clock)


def test_thirty_browsers_fetch_once(lab, cache):
    async def run():
        lab.answers.clear()
        asked = [asyncio.create_task(cache.get(PATH)) for _ in range(30)]
        await asyncio.sleep(0)
        lab.answers.set()
        return await asyncio.gather(*asked)

    pages = asyncio.run(run())
    assert {page.body for page in pages} == {SMALL}
    assert gzip.decompress(pages[0].compressed) == SMALL
    assert pages[0].media_type == "model/gltf-binary"
    assert len(lab.asked) == 1


def test_a_browser_that_goes_away_ends_nobody_else_s_fetch(lab, cache):
    async def run():
        lab.answers.clear()
        gone, waiting = (asyncio.create_task(cache.get(PATH)) for _ in range(2))
        await asyncio.sleep(0)
        gone.cancel()
        await asyncio.sleep(0)
        lab.answers.set()
        return await waiting

    assert asyncio.run(run()).body == SMALL


def test_an_asset_is_compared_with_the_lab_s_now_and_then(lab, cache, clock):
    async def get():
        return (await cache.get(PATH)).body

    assert asyncio.run(get()) == SMALL
    lab.files[KEY] = b"glTF new"
    assert asyncio.run(get()) == SMALL
    assert len(lab.asked) == 1
    clock.now += FRESH_S
    assert asyncio.run(get()) == b"glTF new"
    clock.now += FRESH_S
    lab.asked.clear()
    assert asyncio.run(get()) == b"glTF new"
    assert lab.asked == [f"{KEY}?offset=0;length=0"]


def test_what_is_kept_is_served_while_the_lab_is_away(lab, cache, clock):
    assert asyncio.run(cache.get(PATH)).body == SMALL
    clock.now += FRESH_S
    lab.away = NoAnswer("the lab is away")
    assert asyncio.run(cache.get(PATH)).body == SMALL
    with pytest.raises(NoAnswer):
        asyncio.run(cache.get("robots.json"))


def test_what_the_lab_has_no_more_is_gone(lab, cache, clock):
    asyncio.run(cache.get(PATH))
    clock.now += FRESH_S
    lab.files.clear()
    with pytest.raises(NotFound):
        asyncio.run(cache.get(PATH))
    lab.away = NoAnswer("the lab is away")
    with pytest.raises(NoAnswer):
        asyncio.run(cache.get(PATH))


def test_a_large_asset_is_put_together_from_its_pieces(lab, cache):
    lab.files[KEY] = LARGE
    assert asyncio.run(cache.get(PATH)).body == LARGE
    assert len(lab.asked) == 3


def test_a_very_large_asset_is_streamed_and_not_kept(lab, clock):
    lab.files[KEY] = LARGE
    cache = AssetCache(lab, largest=LARGEST_PIECE, now=clock)

    async def run():
        whole = await cache.get(PATH)
        assert isinstance(whole, Described)
        return b"".join([data async for data in cache.pieces(PATH, whole)])

    assert asyncio.run(run()) == LARGE
    lab.asked.clear()
    assert asyncio.run(run()) == LARGE
    assert len(lab.asked) == 4


def test_pieces_of_two_versions_are_never_put_together(lab, cache):
    lab.files[KEY] = LARGE

    async def run():
        whole = (await cache._piece(PATH, 0, 0))[0]
        stream = cache.pieces(PATH, whole)
        await anext(stream)
        lab.files[KEY] = LARGE[::-1]
        with pytest.raises(Changed):
            await anext(stream)

    asyncio.run(run())


def test_the_least_used_goes_first(lab, clock):
    lab.files |= {f"assets/{n}.png": bytes(1000) for n in range(4)}
    cache = AssetCache(lab, room=3 * 1100, now=clock)

    async def run():
        for name in ("0.png", "1.png", "2.png", "0.png", "3.png"):
            assert isinstance(await cache.get(name), Page)
        lab.asked.clear()
        await cache.get("0.png")
        assert not lab.asked
        await cache.get("1.png")
        assert lab.asked

    asyncio.run(run())
