"""The lab's assets over HTTP, fetched once over zenoh."""
