"""The lab as the gateway sees it: keys of zenoh."""
