"""Jobs of the core: threads, their queue, the compiler of the kernels, what is kept of recordings."""
