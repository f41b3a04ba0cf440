"""Diagnostics of the object store."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

NOT_IN_STORE = Code(
    "not_in_store", "There is nothing under '{key}' in the store.", "Send it again."
)
STORE_SILENT = Code("store_silent", "it does not answer", meaning="Why a store failed.")
STORE_FAILED = Code(
    "store_failed",
    "The store {store} failed ({why:problem}); nothing was changed.",
    "Try again once it works.",
)
NO_STORE = Code(
    "no_store",
    "The store '{store}' cannot be used.",
    "Expected a folder, or an URL such as s3://bucket/lab, gs://bucket/lab or az://container/lab.",
)
STORE_UNUSABLE = Code(
    "store_unusable",
    "The store '{store}' cannot be used: {why:problem}.",
    "Check the URL and the credentials in the environment (docs/store.md).",
)
STORE_FOLDER_UNUSABLE = Code(
    "store_folder_unusable",
    "The folder {folder} cannot be the store: {why:problem}.",
    "Choose another with the parameter store, or another state_dir.",
)
EMPTY_STORE_NAME = Code(
    "empty_store_name", "A name of the store is empty; expected at least one character."
)
NO_UPLOAD_KEY = Code(
    "no_upload_key",
    "'{key}' is no key of {what:choice upload=an upload|draft=a draft}.",
    "Send the file again.",
)
BAD_UPLOAD_NUMBER = Code(
    "bad_upload_number", "'{number}' names nothing that was sent; expected 32 hex digits."
)
