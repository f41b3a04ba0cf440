"""Which bags lie in a folder."""

from __future__ import annotations

from pathlib import Path

# Names that an answer holds: a lab records for years.
MOST = 200


def bags_in(folder: Path, most: int = MOST) -> list[str]:
    """Return the names of the newest bags in a folder, newest first; [] without the folder."""
    found: list[tuple[float, str]] = []
    try:
        entries = list(folder.iterdir())
    except OSError:
        return []
    for entry in entries:
        try:
            files = list(entry.iterdir()) if entry.is_dir() else [entry]
            files = [file for file in files if file.suffix in (".mcap", ".db3")]
            if files and "\n" not in entry.name:
                found.append((max(file.stat().st_mtime for file in files), entry.name))
        except OSError:
            continue  # it was removed meanwhile, or is not ours to read
    return [name for _, name in sorted(found, reverse=True)[:most]]
