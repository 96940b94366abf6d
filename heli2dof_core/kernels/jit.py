"""`kernel`: Numba's compiler, or nothing where this file is loaded as part of `interpreted`."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

if __name__.startswith("heli2dof_core.interpreted"):
    _compile: Callable[..., Any] | None = None

    def _as_it_is(array: Any) -> Any:
        return array

    def _nothing() -> None:
        return None

    read_only: Any = _as_it_is
    keep_apart: Any = _nothing
else:
    from numba import njit, types
    from numba.extending import intrinsic

    # Without Numba's runtime: no reference is counted, which takes longer than the sums here, and a
    # kernel that allocates does not compile. Scratch memory comes from the caller (`WORKSPACE`).
    options: Any = {"cache": True, "error_model": "numpy", "nogil": True, "_nrt": False}
    _compile = njit(**options)

    def _as_given(typing_context, array):
        def same(context, builder, signature, arguments):
            return arguments[0]

        return array.copy(readonly=True)(array), same

    def _without_copies(typing_context):
        def mark(context, builder, signature, arguments):
            builder.function.attributes.add("noinline")
            return context.get_dummy_value()

        return types.none(), mark

    read_only: Any = intrinsic(_as_given)
    """The same array as one that nobody may change: the type that kernels take of results."""
    keep_apart: Any = intrinsic(_without_copies)
    """Keeps a large kernel out of those that call it: copies of it within would take minutes to compile."""


def kernel(function: Callable[..., Any]) -> Callable[..., Any]:
    """The function, compiled on its first call; or as it is."""
    return _compile(function) if _compile else function


ENTRIES: dict[str, Callable[..., Any]] = {}
"""The kernels that `engine` hands out, by name."""
EXAMPLES: dict[str, tuple[Callable[[], tuple[Any, ...]], ...]] = {}
"""For each, arguments of the only types that it takes."""


def entry_point(
    example: Callable[..., tuple[Any, ...]], *sizes: Any
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Marks a kernel that `engine` hands out, with an example of its arguments: it is compiled for no others.

    With `sizes` there is one for each of them, made by `example` of the size.
    """

    def marked(function: Callable[..., Any]) -> Callable[..., Any]:
        made = tuple(partial(example, size) for size in sizes) if sizes else (example,)
        EXAMPLES[function.__name__] = made
        ENTRIES[function.__name__] = kernel(function)
        return ENTRIES[function.__name__]

    return marked


@kernel
def copy_into(source, target):
    """target[:] = source; a slice assignment would allocate, in case the two overlap."""
    for i in range(len(source)):
        target[i] = source[i]
