#!/bin/sh
# Dask: Client.get_executor() is an Executor that runs equal calls once, and says "cancelled" of what runs on.
#
# One expects: an Executor of concurrent.futures can be changed for another: map and submit call the function each
#   time; cancel() of a call that runs is False, as Python's documentation has it; running() tells that it runs.
# What happens: (1) a call is known by function and arguments (pure=True), so equal ones share one result while a
#   future of it lives: five noisy experiments with the same settings have one outcome. (2) cancel() of a
#   call that runs returns True, cancelled() and done() are True at once, and the function goes on to its end and does
#   what it does to files and rigs. running() is False all the while.
# Seen with: dask and distributed 2026.8.0, numpy 2.4.6.
# Why it matters: Monte Carlo that draws in the worker has a spread of 0, without a word. Ask for
#   get_executor(pure=False) and give each call its own seed; do not take cancelled() for "has stopped".
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet dask==2026.8.0 distributed==2026.8.0 numpy==2.4.6
cat > "$folder/ask.py" <<'EOF'
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from distributed import Client, Event, LocalCluster

PATIENCE = 60  # seconds, for an event that comes at once


def measured(settling_time):
    """A figure with noise of its own."""
    return settling_time + 0.01 * float(np.random.default_rng().standard_normal())


def by_submit(executor):
    futures = [executor.submit(measured, 3.0) for _ in range(5)]
    return [future.result() for future in futures]


def called_off(executor, event):
    """What the future of a call that runs says, and whether the call came to its end all the same."""
    begun, go, ended = (event(name) for name in ("begun", "go", "ended"))
    future = executor.submit(run, begun, go, ended)
    assert begun.wait(timeout=PATIENCE)
    says = {"running": future.running(), "cancel": future.cancel(), "cancelled": future.cancelled()}
    says["done"] = future.done()
    go.set()
    return says, ended.wait(timeout=PATIENCE)


def run(begun, go, ended):
    begun.set()
    if go.wait(timeout=PATIENCE):
        ended.set()


if __name__ == "__main__":
    with ThreadPoolExecutor(2) as threads:
        mapped, submitted = list(threads.map(measured, [3.0] * 5)), by_submit(threads)
        print("threads: map", len(set(mapped)), "values of 5, submit", len(set(submitted)))
        assert len(set(mapped)) == len(set(submitted)) == 5
        says, ended = called_off(threads, lambda name: threading.Event())
        print("threads: a call that runs:", says, "| comes to its end:", ended)
        assert says == {"running": True, "cancel": False, "cancelled": False, "done": False} and ended
    with LocalCluster(n_workers=1, threads_per_worker=2, processes=False, dashboard_address=None) as cluster:
        with Client(cluster) as client:
            mapped, submitted = list(client.get_executor().map(measured, [3.0] * 5)), by_submit(client.get_executor())
            print("Dask: map", mapped, "submit", submitted)
            assert len(set(mapped)) == len(set(submitted)) == 1
            impure = client.get_executor(pure=False)
            mapped, submitted = list(impure.map(measured, [3.0] * 5)), by_submit(impure)
            print("Dask, pure=False: map", len(set(mapped)), "values of 5, submit", len(set(submitted)))
            assert len(set(mapped)) == len(set(submitted)) == 5
            says, ended = called_off(impure, Event)
            print("Dask: a call that runs:", says, "| comes to its end:", ended)
            assert says == {"running": False, "cancel": True, "cancelled": True, "done": True} and ended
EOF
"$folder/venv/bin/python" "$folder/ask.py"
