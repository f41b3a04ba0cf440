"""The recorder node: recording, replay and attachments."""
