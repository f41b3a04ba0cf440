"""Robots and things on the stage of the pages or of the room, in Chromium without a lab."""

from __future__ import annotations

import base64
import io
import math
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import Any

from PIL import Image
from playwright.sync_api import Page, sync_playwright

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.object_meshes import ObjectMeshes
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.physics import catalogue

ROOT = Path(__file__).resolve().parents[1]
ASSETS = "/assets/mrlab_ros/"
ARGUMENTS = (
    *("--headless=new", "--no-sandbox"),
    *("--enable-unsafe-swiftshader", "--use-angle=swiftshader"),
)
# Pictures show what a computer with a GPU shows, also where a processor takes its part.
AS_A_GPU = """
const asked = WebGL2RenderingContext.prototype.getParameter
WebGL2RenderingContext.prototype.getParameter = function (name) {
  const found = asked.call(this, name)
  return typeof found === 'string' && /swiftshader/i.test(found) ? 'GPU' : found
}
"""

GROUNDS = {"light": (240, 242, 245, 255), "dark": (30, 34, 40, 255)}
HERE = {"position": {"x": 0, "y": 0, "z": 0}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}


class Faces:
    """A page that shows robots and things."""

    def __init__(self, page: Page, url: str) -> None:
        self.page, self._url = page, url
        self._library = RobotLibrary(ROOT / "robots", ROOT / "robots" / "none imported")
        self._types = catalogue.parse(
            read_yaml(ROOT / "config" / "objects.yaml"), ObjectMeshes(ROOT, 20_000)
        )

    def show(
        self,
        robots: Sequence[Mapping[str, Any]] = (),
        things: Sequence[Mapping[str, Any]] = (),
        stage: str = "page",
        theme: str = "light",
    ) -> float:
        """Show robots (id, tool, at, positions) and things with a mesh (id, at).

        Returns s until all are whole. at: x, y, z in m and the turn about z in rad; positions:
        rad, home where there are none.
        """
        self.page.goto(self._url)
        self.page.evaluate("name => { document.documentElement.dataset.theme = name }", theme)
        self._ground = GROUNDS[theme]
        shown = {
            "stage": stage,
            "robots": [self._robot(n, each) for n, each in enumerate(robots)],
            "objects": [self._thing(n, each) for n, each in enumerate(things)],
        }
        return float(self.page.evaluate("shown => window.show(shown)", shown))

    def look(self, eyes: Sequence[float], at: Sequence[float], angle: float = 32) -> Image.Image:
        """Return what is seen from one place of the lab at another, m. angle: upright, degrees."""
        view = {"eyes": list(eyes), "at": list(at), "angle": angle}
        found = self.page.evaluate("view => window.look(view)", view)
        seen = Image.open(io.BytesIO(base64.b64decode(found.split(",")[1]))).convert("RGBA")
        ground = Image.new("RGBA", seen.size, self._ground)
        return Image.alpha_composite(ground, seen).convert("RGB")

    def reach(self, robot: str) -> float:
        """Return how far a robot reaches, m."""
        return float(read_yaml(ROOT / "robots" / robot / "robot.yaml")["reach"])

    def throttle(self, mbit: float) -> None:
        """Let the network carry so many Mbit/s, 20 ms away, without a cache."""
        devtools = self.page.context.new_cdp_session(self.page)
        devtools.send("Network.enable")
        devtools.send("Network.setCacheDisabled", {"cacheDisabled": True})
        rate = mbit * 1e6 / 8
        devtools.send(
            "Network.emulateNetworkConditions",
            {
                "offline": False,
                "latency": 20,
                "downloadThroughput": rate,
                "uploadThroughput": rate,
            },
        )

    def cost(self) -> dict[str, float]:
        """Return calls, triangles and bytes of textures of the last picture."""
        return dict(self.page.evaluate("() => window.cost()"))

    def _robot(self, number: int, stated: Mapping[str, Any]) -> dict[str, Any]:
        model = self._library.model(stated["id"])
        return {
            "name": f"robot_{number}",
            "urdf": self._library.description(stated["id"], stated.get("tool")),
            "pose": _pose(stated.get("at", (0, 0, 0, 0))),
            "joint_names": list(model.joint_names),
            "positions": [float(v) for v in stated.get("positions", model.home)],
        }

    def _thing(self, number: int, stated: Mapping[str, Any]) -> dict[str, Any]:
        kind = self._types.get(stated["id"])
        red, green, blue, alpha = kind.color
        return {
            "name": f"thing_{number}",
            "pose": _pose(stated["at"]),
            "mesh": kind.mesh,
            "size": {"x": 0, "y": 0, "z": 0},
            "color": {"r": red, "g": green, "b": blue, "a": alpha},
            "primitive": {"type": 0, "dimensions": []},
            "held_by": "",
        }


def _pose(at: Sequence[float]) -> dict[str, Any]:
    x, y, z, turn = at
    half = turn / 2
    return {
        "position": {"x": x, "y": y, "z": z},
        "orientation": {"x": 0, "y": 0, "z": math.sin(half), "w": math.cos(half)},
    }


class _Handler(SimpleHTTPRequestHandler):
    def __init__(self, built: Path, *args: Any) -> None:
        self._built = built
        super().__init__(*args)

    def translate_path(self, path: str) -> str:
        path = path.split("?")[0]
        if path.startswith(ASSETS):
            return str(ROOT / path.removeprefix(ASSETS))
        return str(self._built / (path.lstrip("/") or "index.html"))

    def log_message(self, *_: Any) -> None:
        pass


@contextmanager
def faces(size: tuple[int, int] = (1200, 900), gpu: bool = True) -> Iterator[Faces]:
    """Open the page. size: pixels; gpu: light as on a computer that has one."""
    with tempfile.TemporaryDirectory() as folder:
        built = Path(folder)
        subprocess.run(
            [
                *("node", "node_modules/.bin/vite", "build", "bench", "--outDir", folder),
                *("--emptyOutDir", "--config", "vite.config.ts", "--logLevel", "warn"),
            ],
            cwd=ROOT / "web",
            check=True,
        )
        server = ThreadingHTTPServer(("127.0.0.1", 0), partial(_Handler, built))
        Thread(target=server.serve_forever, daemon=True).start()
        path = shutil.which("chromium") or shutil.which("google-chrome")
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=path, args=list(ARGUMENTS))
            page = browser.new_page(viewport={"width": size[0], "height": size[1]})
            page.set_default_timeout(240_000)
            page.on("console", lambda said: print(said.text) if said.type == "error" else None)
            page.on("pageerror", lambda error: print(error))
            if gpu:
                page.add_init_script(AS_A_GPU)
            yield Faces(page, f"http://127.0.0.1:{server.server_port}/")
            browser.close()
        server.shutdown()
