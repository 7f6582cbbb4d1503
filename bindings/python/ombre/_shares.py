"""Jobs whose pieces the workers of a client make: Dask's, or an executor of concurrent.futures."""
import contextlib
import json
import os

from ._commands import Progress, run


def _is_dask(client):
    return hasattr(client, "nthreads")


def _workers(client):
    """How many shares the client makes at once."""
    if _is_dask(client):
        return sum(client.nthreads().values())
    return getattr(client, "_max_workers", None) or os.cpu_count()


def _checked(shares, usual):
    if shares is None:
        return usual
    if int(shares) != shares or shares < 1:
        raise ValueError(f"shares is a whole number from 1 on, not {shares!r}")
    return int(shares)


def _refuse(options, *names):
    wrong = sorted(set(names) & options.keys())
    if wrong:
        raise TypeError(f"{wrong[0]} does not go with client")


def _make_all(client, make, calls, shown=None):
    """Calls `make` by the workers, and waits; after an error nothing more is begun."""
    kept = {"pure": False} if _is_dask(client) else {}  # Dask would take equal calls for one
    with contextlib.ExitStack() as undone:
        waiting = [client.submit(make, *call, **kept) for call in calls]
        for future in waiting:
            undone.callback(future.cancel)
        for count, future in enumerate(waiting, 1):
            future.result()
            if shown:
                shown.update({"steps_done": count, "steps_total": len(calls)})


def _slice_share(design, folder, share, options):
    design.slice(folder, shard=share, **options)


def slice_by(client, design, folder, shares, progress, options):
    """Slices by a client, and joins the layers; returns the report."""
    _refuse(options, "shard", "resume", "force", "dry_run")
    count = _checked(shares, 4 * _workers(client))  # so that none waits long for the last one
    folder = os.path.abspath(folder)
    with contextlib.closing(Progress(progress)) as shown:
        _make_all(client, _slice_share, [(design, folder, f"{n}/{count}", options) for n in range(1, count + 1)], shown)
    return design.slice(folder, resume=True, **options)


def _run_share(plan, number):
    run("run", {"plan": plan, "shard": str(number)}, {})


def optimise_by(client, members, shares, progress):
    """Searches, with designs that a client's workers measure, all that the search asks for at once; returns the report.

    `members` are those of a job of the kind optimise. The plans lie beside the folder until the search is over.
    """
    _refuse(members, "resume", "force")
    count = _checked(shares, _workers(client))
    folder = members["output"]
    job, plan = folder + ".job.json", folder + ".plan.json"
    with contextlib.closing(Progress(progress)) as shown:
        try:
            with open(job, "x", encoding="utf-8") as file:
                json.dump({"format": "ombre job, version 1", "kind": "optimise", "options": members}, file)
            while True:
                run("plan", {"job": job, "output": plan, "shards": str(count), "force": True}, {})
                _make_all(client, _run_share, [(plan, n) for n in range(1, count + 1)])
                report = run("gather", {"plan": plan}, {})[0]
                goes_on = [event for event in report.events if event["event"] == "designs"]
                if not goes_on:
                    return report
                known, following = goes_on[-1]["known"], goes_on[-1]["next"]
                shown.update({"steps_done": known, "steps_total": known + following})
        finally:
            for path in (job, plan):
                with contextlib.suppress(FileNotFoundError):
                    os.remove(path)
