"""The list of trajectories: search, comparison, download, deletion and its undo."""

from __future__ import annotations

import json
import re
from pathlib import Path

import scipy.io
import student_files
from page_objects import UploadPage
from playwright.sync_api import Page, expect
from served_lab import ServedLab


def published(page: Page, lab: ServedLab, tmp_path: Path, name: str, size: float) -> None:
    upload = UploadPage(page)
    page.goto(lab.url)
    upload.send(student_files.good(tmp_path, f"{name}.mat", size))
    upload.publish(name)


def test_trajectories_are_found_compared_downloaded_and_brought_back(
    page: Page, lab: ServedLab, tmp_path: Path
) -> None:
    published(page, lab, tmp_path, "small", 0.4)
    published(page, lab, tmp_path, "large", 0.5)
    page.get_by_role("link", name="Trajectories", exact=True).click()
    search = page.get_by_role("searchbox")
    search.fill("small")
    expect(page.locator(".trajectory")).to_have_count(1)
    page.get_by_label("Compare small").or_(page.get_by_label("Compare local/small")).check()
    search.fill("large")
    page.get_by_label("Compare large").or_(page.get_by_label("Compare local/large")).check()
    page.get_by_role("button", name="Compare", exact=True).click()
    # 0.1 rad, in the first and the last joint
    expect(page.locator(".comparison-result")).to_contain_text("5.73°")
    expect(page.locator(".comparison-result")).to_contain_text("row 101")
    page.get_by_role("button", name="End the comparison").click()
    expect(page.locator(".comparison")).to_have_count(0)
    for kind, read in (("MATLAB (.mat)", scipy.io.loadmat), ("JSON", _json)):
        page.get_by_role("button", name="Download").click()
        with page.expect_download() as waiting:
            page.get_by_role("link", name=kind).click()
        path = tmp_path / waiting.value.suggested_filename
        waiting.value.save_as(path)
        assert read(path)
    page.get_by_role("button", name=re.compile("What to do with")).click()
    page.get_by_role("button", name="Delete").click()
    expect(page.get_by_text("was deleted")).to_be_visible()
    page.get_by_role("button", name="Undo").click()
    search.fill("small")
    expect(page.locator(".trajectory")).to_have_count(1)


def _json(path: Path) -> object:
    return json.loads(path.read_text())
