"""State feedback for any (A, B): one file per method, one protocol (`method`), one `registry`."""
