"""Mutation testing by sample: `python -m tests.mutation [--seed N] [--count 40]`.

The core and the page's pure modules are changed in one place at a time, in a temporary copy, and the tests that
could notice it run there. Whatever survives is printed with file, line and change: a gap in the tests, or a change
that makes no difference, which `equal.json` lists with the reason.

Why no tool of others: mutmut wraps each function in a dispatcher that Numba cannot compile, cosmic-ray changes type
hints and edits in place, Stryker knows no Python; together they would need two configurations and the sampling
would still be ours.
"""
