"""Object storage: a folder, S3, Google Cloud Storage or Azure behind one small port."""
