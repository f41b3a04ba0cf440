"""The keys folder: people, certificates and the files of zenoh."""
