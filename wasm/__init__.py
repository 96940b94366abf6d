"""Builds the page's WebAssembly module of the hot loops from the same Python sources: `python -m wasm`.

Numba compiles each entry point (`entries`) to LLVM's intermediate language (`lowering`); LLVM's own WebAssembly back
end makes an object of it, and wasm-ld a module (`module`). What each function takes is told to JavaScript by a table
(`table`). Both are kept in static/kernel/, with a stamp of what they were made from (`stamp`).
"""
