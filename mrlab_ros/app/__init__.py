"""Use cases, which every door calls: no node, no HTTP, nothing printed."""
