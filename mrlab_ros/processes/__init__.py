"""The lab's processes: their list, the host, the supervisor."""
