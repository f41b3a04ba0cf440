"""A course on a learning platform, the gateway that is its tool, and browsers between them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import yaml
from gateway_side import Browser, Gateway
from learning_platform import LearningPlatform, some_key

SITE = "https://lab.example.org"


class Course:
    """A platform, and the gateway that is its tool."""

    def __init__(self, folder: Path) -> None:
        self.gateway: Gateway
        keys = lambda: self.gateway.anyone.get("/api/lti/keys").json()  # noqa: E731
        self.platform = LearningPlatform(keys, lambda: self.gateway.clock())
        file = folder / "lti.yaml"
        file.write_text(yaml.safe_dump(self.platform.settings()))
        (folder / "state").mkdir()
        own = some_key().as_dict(private=True)
        (folder / "state" / "lti_key.json").write_text(json.dumps(own))
        self.gateway = Gateway(folder, public_url=SITE, lti=file, classroom=folder / "class")

    def begin(self, browser: Browser, who: str, kind: str = "open") -> str:
        """Begin a launch; return where the platform is asked."""
        asked = self.platform.begins(who, kind)
        answer = browser.http.post("/api/lti/login", data=asked, follow_redirects=False)
        assert answer.status_code == 303, answer.text
        return str(answer.headers["location"])

    def finish(self, browser: Browser, form: dict[str, str], **headers: str) -> Any:
        """Post what the platform gave, as its page does."""
        origin = {"origin": self.platform.url, **headers}
        return browser.http.post(
            "/api/lti/launch", data=form, headers=origin, follow_redirects=False
        )

    def launch(self, browser: Browser, who: str, kind: str = "open") -> Any:
        return self.finish(browser, self.platform.launched(self.begin(browser, who, kind)))
