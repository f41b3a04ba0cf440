"""Use cases, which every door calls: no node, no page, nothing printed."""
