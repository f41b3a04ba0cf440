#!/usr/bin/env python3
"""Build the site of docs/ into build/site; fetch mermaid, which draws diagrams, the first time.

`--serve` shows it at http://127.0.0.1:8000 and builds it again whenever a page is saved.
"""

from __future__ import annotations

import argparse
import base64
import hashlib
import os
import subprocess
import sys
import tarfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "build" / "mermaid"
# The package alone: its bundle needs none of the packages that it depends on. The newest that
# Material's colours fit.
MERMAID = "mermaid@11.17.2"
INTEGRITY = (
    "V6K3C8EBdEsPFZXSKMJe6ppQOENxuHARr9GvHX4hh47lAbhMRD9qf4oEK7LoaRQxULMa80/qt5gHO73aCleBBg=="
)


def fetch_mermaid() -> None:
    """Put mermaid's bundle into build/mermaid; raise SystemExit where another one arrives."""
    if (FOLDER / "mermaid.min.js").is_file():
        return
    FOLDER.mkdir(parents=True, exist_ok=True)
    npm = [str(ROOT / "scripts" / "npm"), "pack", MERMAID, "--silent"]
    done = subprocess.run([*npm, "--pack-destination", str(FOLDER)], text=True, check=False)
    packed = next(FOLDER.glob("*.tgz"), None)
    if done.returncode or packed is None:
        raise SystemExit(f"{MERMAID} could not be fetched; the site needs the network once")
    found = base64.b64encode(hashlib.sha512(packed.read_bytes()).digest()).decode()
    if found != INTEGRITY:
        packed.unlink()
        raise SystemExit(
            f"{MERMAID} has the sha512 {found}, expected {INTEGRITY}; nothing was built"
        )
    with tarfile.open(packed) as archive:
        bundle = archive.extractfile("package/dist/mermaid.min.js")
        assert bundle is not None
        (FOLDER / "mermaid.min.js").write_bytes(bundle.read())
    packed.unlink()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--serve", action="store_true", help="show the site, and keep it current")
    serve = parser.parse_args().serve
    fetch_mermaid()
    # The advertisement of another generator, in each build.
    env = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    config = ("-f", str(ROOT / "scripts" / "site" / "mkdocs.yml"))
    command = ("serve", *config) if serve else ("build", "-q", *config)
    code = subprocess.run(
        [sys.executable, "-m", "mkdocs", *command], env=env, check=False
    ).returncode
    if not code and not serve:
        print(f"the site is in {ROOT / 'build' / 'site'}; open index.html there")
    return code


if __name__ == "__main__":
    sys.exit(main())
