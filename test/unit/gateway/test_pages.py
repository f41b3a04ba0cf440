"""The built pages: types, ETags, caching, and what is no page."""

from __future__ import annotations

import gzip
from collections.abc import Iterator
from pathlib import Path

import pytest
from gateway_side import Gateway, code_of

SCRIPT = "export const x = 1\n" * 50


@pytest.fixture
def lab(tmp_path: Path) -> Iterator[Gateway]:
    pages = tmp_path / "dist"
    (pages / "static").mkdir(parents=True)
    (pages / "index.html").write_text("<!doctype html><title>here</title>")
    (pages / "static" / "main-1a2b.js").write_text(SCRIPT)
    (pages / "static" / "robot.glb").write_bytes(b"glTF")
    (tmp_path / "secret.txt").write_text("only mine")
    with Gateway(tmp_path, pages=pages) as gateway:
        yield gateway


def test_the_application_answers_every_path_that_is_its_own(lab: Gateway) -> None:
    for path in ("/", "/lab", "/trajectories/anna/wave", "/invitation/x.y"):
        response = lab.anyone.get(path)
        assert "<title>here" in response.text
        assert response.headers["content-type"] == "text/html; charset=utf-8"
        assert response.headers["cache-control"] == "no-cache"


@pytest.mark.parametrize("path", ["/api/x", "/static/gone.js", "/gone.js"])
def test_a_missing_file_is_no_page(lab: Gateway, path: str) -> None:
    assert code_of(lab.anyone.get(path)) == (404, "nothing_at")


def test_what_no_api_answers_says_so_whatever_the_method(lab: Gateway) -> None:
    known = lab.browser()
    for method in ("POST", "PUT", "PATCH", "DELETE"):
        assert code_of(known.send(method, "/api/nothing")) == (404, "nothing_at")
    # what is there is there, for another method
    assert code_of(known.send("POST", "/api/devices")) == (405, "method_not_possible")


def test_files_with_fingerprints_are_kept_for_ever(lab: Gateway) -> None:
    response = lab.anyone.get("/static/main-1a2b.js")
    assert response.headers["cache-control"] == "public, max-age=31536000, immutable"
    assert response.headers["content-type"] == "text/javascript; charset=utf-8"
    assert lab.anyone.get("/static/robot.glb").headers["content-type"] == "model/gltf-binary"


def test_a_known_file_is_not_sent_again(lab: Gateway) -> None:
    first = lab.anyone.get("/static/main-1a2b.js")
    etag = first.headers["etag"]
    for known in (etag, f'"x", W/{etag}', "*"):
        again = lab.anyone.get("/static/main-1a2b.js", headers={"if-none-match": known})
        assert (again.status_code, again.content) == (304, b"")
    plain = {"if-none-match": etag, "accept-encoding": "identity"}
    assert lab.anyone.get("/static/main-1a2b.js", headers=plain).status_code == 200


def test_texts_are_compressed_where_the_browser_takes_that(lab: Gateway) -> None:
    path = "/static/main-1a2b.js"
    for accepted, packed in (("gzip, br", True), ("gzip;q=0", False), ("", False)):
        response = lab.anyone.get(path, headers={"accept-encoding": accepted})
        assert ("content-encoding" in response.headers) == packed
        assert response.text == SCRIPT
    assert len(gzip.compress(SCRIPT.encode())) < len(SCRIPT) / 4


@pytest.mark.parametrize("path", ["/%2e%2e/secret.txt", "/static/..%2f..%2fsecret.txt"])
def test_nothing_outside_the_folder_is_sent(lab: Gateway, path: str) -> None:
    assert "only mine" not in lab.anyone.get(path).text


def test_a_page_that_was_built_anew_is_read_again(lab: Gateway) -> None:
    lab.anyone.get("/")
    assert lab.settings.pages
    index = lab.settings.pages / "index.html"
    index.write_text("<!doctype html><title>new</title>")
    assert "<title>new" in lab.anyone.get("/").text


def test_without_built_pages_it_says_how_to_build_them(tmp_path: Path) -> None:
    with Gateway(tmp_path, pages=tmp_path / "none") as lab:
        response = lab.anyone.get("/")
        assert response.status_code == 503
        assert "scripts/npm run build" in response.text
