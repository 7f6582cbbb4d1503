#!/usr/bin/env python3
"""Does what `auditwheel repair` does, and bundles all libraries but those of the C and C++ runtimes.

    build/venv/bin/python tools/repair_wheel.py --plat manylinux_2_36_x86_64 -w out ombre.whl

The policies of manylinux leave out libraries that desktops have (glib, X11, expat); servers and containers lack them.
"""
import json
import pathlib
import sys
import tempfile

from auditwheel import policy
from auditwheel.libc import Libc
from auditwheel.main import main

# Parts of glibc, and of GCC's runtime, which belongs to the system's glibc.
SYSTEM = {"libc.so.6", "libm.so.6", "libmvec.so.1", "libdl.so.2", "librt.so.1", "libpthread.so.0", "libutil.so.1",
          "libresolv.so.2", "libanl.so.1", "libgcc_s.so.1", "libstdc++.so.6"}


def bundle_more(folder):
    policies = json.loads(policy._POLICY_JSON_MAP[Libc.GLIBC].read_text(encoding="utf-8"))
    for one in policies:
        one["lib_whitelist"] = [name for name in one["lib_whitelist"] if name in SYSTEM]
    path = pathlib.Path(folder) / "policies.json"
    path.write_text(json.dumps(policies), encoding="utf-8")
    policy._POLICY_JSON_MAP[Libc.GLIBC] = path


if __name__ == "__main__":
    sys.argv.insert(1, "repair")
    with tempfile.TemporaryDirectory() as work:
        bundle_more(work)
        sys.exit(main())
