"""`python -m app serve`: the command line from a checkout."""

from .cli import main

main()
