"""Which bags lie in a folder."""

from __future__ import annotations

from pathlib import Path

from mrlab_ros.adapters.bags.reader import mcap_files_in

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
            files = mcap_files_in(entry) if entry.is_dir() else [entry]
            files = [file for file in files if file.suffix == ".mcap"]
            if files and "\n" not in entry.name:
                found.append((max(file.stat().st_mtime for file in files), entry.name))
        except OSError:
            continue  # it was removed meanwhile, or is not ours to read
    return [name for _, name in sorted(found, reverse=True)[:most]]
