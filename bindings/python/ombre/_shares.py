"""Slice jobs whose layers several processes make."""
import contextlib
import os

from ._commands import Progress


def _workers(client):
    """How many shares the client makes at once."""
    if hasattr(client, "nthreads"):  # of Dask
        return sum(client.nthreads().values())
    return getattr(client, "_max_workers", None) or os.cpu_count()


def _make(design, folder, share, options):
    design.slice(folder, shard=share, **options)


def slice_by(client, design, folder, shares, progress, options):
    """Slices by a client of Dask, or an executor of concurrent.futures, and joins the layers; returns the report."""
    wrong = sorted({"shard", "resume", "force", "dry_run"} & options.keys())
    if wrong:
        raise TypeError(f"{wrong[0]} does not go with client")
    if shares is None:
        shares = 4 * _workers(client)  # so that none waits long for the last one
    elif int(shares) != shares or shares < 1:
        raise ValueError(f"shares is a whole number from 1 on, not {shares!r}")
    folder = os.path.abspath(folder)
    kept = {"pure": False} if hasattr(client, "nthreads") else {}  # Dask would take equal calls for one
    with contextlib.ExitStack() as undone:
        shown = undone.enter_context(contextlib.closing(Progress(progress)))
        waiting = [client.submit(_make, design, folder, f"{n}/{shares}", options, **kept) for n in range(1, shares + 1)]
        for future in waiting:
            undone.callback(future.cancel)
        for count, future in enumerate(waiting, 1):
            future.result()
            shown.update({"steps_done": count, "steps_total": shares})
    return design.slice(folder, resume=True, **options)
