"""What callers send and get: requests, replies, problems, and how each follows from the core."""
