"""The bridge's rules: topics and services, rights, latency."""
