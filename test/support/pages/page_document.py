"""What a page of one file holds for its script."""

from __future__ import annotations

import base64
import json
import re
import struct
import zlib
from pathlib import Path
from typing import Any


def document_in(page: Path) -> dict[str, Any]:
    """Return the document that a page carries."""
    (packed,) = re.findall(r'id="data">([^<]*)</script>', page.read_text())
    content = zlib.decompress(base64.b64decode(packed))
    (length,) = struct.unpack_from("<I", content)
    found: dict[str, Any] = json.loads(content[4 : 4 + length])["document"]
    return found
