"""Runs tests that count what they do (tests/reliability/record.hpp) and reads their records."""

import json
import os
import shutil
import subprocess
import sys

from common import build, fail, root


def run_tests(part, chosen, *programs):
    """All tests of these programs that match the filter of GoogleTest must pass, on every kernel
    table. Gives the rows of each kind of record."""
    records = root / "build/release/reliability" / part
    build("release", *programs)
    shutil.rmtree(records, ignore_errors=True)
    # Two threads, so that restarts with one and with two are two things.
    environment = {**os.environ, "GRAINFIELD_RELIABILITY": str(records), "OMP_NUM_THREADS": "2",
                   "OMP_WAIT_POLICY": "passive",  # others may use the machine
                   "GRAINFIELD_TEST_KERNELS": "all"}
    for program in programs:
        command = [root / "build/release/tests" / program, f"--gtest_filter={chosen}"]
        if subprocess.run(command, cwd=root, env=environment, stdout=sys.stderr).returncode != 0:
            fail("a test failed: the page stays as it was")
    return {file.stem: [json.loads(line) for line in file.read_text().splitlines()]
            for file in records.glob("*.jsonl")}


def grouped(rows, *keys):
    """Rows of equal values of these keys together, in the order of their first."""
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return groups
