"""The WebSocket that carries the lab's keys to browsers; docs/link.md has its byte layout."""
