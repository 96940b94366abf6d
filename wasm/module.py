"""From LLVM's intermediate language to a WebAssembly module, by LLVM and wasm-ld."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from llvmlite import binding as llvm

from wasm.lowering import Lowered, retargeted

TRIPLE = "wasm32-unknown-unknown"
MATH = ("atan2", "cos", "exp", "exp2", "fmod", "hypot", "log", "log2", "pow", "sin", "tan")
"""What the module may import, from `env`: JavaScript has all of these (static/kernel/module.js)."""
STACK = 65536
"""Bytes. It lies at the beginning of the memory, so that a stack that grows too large ends the call."""
NEVER = -10_000
"""How much smaller than a call a function has to be to be inlined before it was optimised itself."""


def build(kernels: Sequence[Lowered]) -> bytes:
    """The module: exports each kernel by its name, `memory`, and `__heap_base`, behind which the memory is free."""
    return link(emit(kernels), [kernel.name for kernel in kernels])


def emit(kernels: Sequence[Lowered]) -> bytes:
    """An object file of all kernels; what they share is there once."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    target: Any = llvm.Target.from_triple(TRIPLE)
    machine = target.create_target_machine(opt=2, reloc="static")
    whole = joined(kernels, str(machine.target_data))
    optimise(whole, machine)
    return machine.emit_object(whole)


def joined(kernels: Sequence[Lowered], layout: str) -> Any:
    """One module with nothing visible but the kernels."""
    whole: Any = None
    for kernel in kernels:
        part = llvm.parse_assembly(retargeted(kernel.text, TRIPLE, layout))
        part.verify()
        if whole is None:
            whole = part
        else:
            whole.link_in(part)
    exports = {kernel.symbol: kernel.name for kernel in kernels}
    for variable in whole.global_variables:
        if not variable.is_declaration:
            variable.linkage = "internal"
    for function in list(whole.functions):
        if not function.is_declaration:
            function.linkage = "external" if function.name in exports else "internal"
            function.add_function_attribute("optsize")
            function.name = exports.get(function.name, function.name)
    return whole


def optimise(module: Any, machine: Any) -> None:
    """As -Os does, twice: what is called more than once gets small first, and only then is inlined or not."""
    unused: Any = llvm.create_new_module_pass_manager()
    unused.add_global_dead_code_eliminate_pass()  # Python's wrappers above all
    unused.run(module, passes(machine))
    for inlining in (False, True):
        builder = passes(machine, inlining)
        builder.getModulePassManager().run(module, builder)


def passes(machine: Any, inlining: bool = True) -> Any:
    """LLVM's passes without its vectorizers: the browser's compiler is asked for nothing beyond plain numbers."""
    options: Any = llvm.create_pipeline_tuning_options(speed_level=2)
    options.loop_vectorization = options.slp_vectorization = False
    if not inlining:
        options.inlining_threshold = NEVER
    return llvm.create_pass_builder(machine, options)


def link(compiled: bytes, exports: Sequence[str]) -> bytes:
    """The module of an object file, by wasm-ld.

    Raises:
        FileNotFoundError: there is no wasm-ld.
        subprocess.CalledProcessError: something is called that is in neither `compiled` nor MATH.
    """
    with tempfile.TemporaryDirectory() as folder:
        source, made, math = (Path(folder) / name for name in ("kernels.o", "kernels.wasm", "math"))
        source.write_bytes(compiled)
        math.write_text("\n".join(MATH), "utf-8")
        options = ("--no-entry", "--strip-all", "--stack-first", "-z", f"stack-size={STACK}", "-O2")
        wanted = [f"--export={name}" for name in (*exports, "__heap_base")]
        command = (*linker(), *options, *wanted)
        subprocess.run((*command, f"--allow-undefined-file={math}", source, "-o", made), check=True)
        return made.read_bytes()


def linker() -> tuple[str, ...]:
    """How wasm-ld is called: the system's, or the one of the package `ziglang`. LLD 14 and 22 make the same bytes.

    Raises:
        FileNotFoundError: there is neither.
    """
    found = shutil.which("wasm-ld")
    if found:
        return (found,)
    if find_spec("ziglang"):
        return sys.executable, "-m", "ziglang", "wasm-ld"
    raise FileNotFoundError(
        "wasm-ld is missing. Debian: apt-get install lld. Elsewhere: pip install '.[wasm]'."
    )
