"""Runs GoogleTest programs, the quickest tests first, until one fails."""

import dataclasses
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import tempfile

FAILED = re.compile(r"^\[  FAILED  \] ([\w/.]+)", re.MULTILINE)
STARTED = re.compile(r"^\[ RUN      \] ([\w/.]+)", re.MULTILINE)


@dataclasses.dataclass
class Batch:
    """Some tests of one program."""

    program: pathlib.Path
    tests: list
    seconds: float  # they usually take

    def pick(self, test):
        return Batch(self.program, [test], self.seconds)


@dataclasses.dataclass
class Outcome:
    passed: bool
    test: str = ""  # the first that failed
    how: str = ""  # "failed", "crashed", "ran out of time"


def run(batch, environment, limit):
    """Stops at the first failure, or after so many seconds of processor time: on a busy machine a
    clock would take the slow for the endless."""
    def bounded():
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))

    with tempfile.NamedTemporaryFile("w", suffix=".flags") as flags:
        flags.write("--gtest_fail_fast\n--gtest_filter=" + ":".join(batch.tests) + "\n")
        flags.flush()
        process = subprocess.run(
            [batch.program, f"--gtest_flagfile={flags.name}"], env=os.environ | environment,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
            preexec_fn=bounded)
    output = process.stdout
    how = "ran out of time" if process.returncode == -signal.SIGXCPU else "crashed"
    if process.returncode == 0 and "[  PASSED  ]" in output:
        return Outcome(True)
    if found := FAILED.findall(output):
        return Outcome(False, found[0], "failed")
    started = STARTED.findall(output)
    return Outcome(False, started[-1] if started else batch.program.name, how)


def timed(program, tests, environment):
    """Runs tests of a program; their names and times, those that failed, those skipped."""
    with tempfile.TemporaryDirectory() as folder:
        report, flags = pathlib.Path(folder) / "report.json", pathlib.Path(folder) / "flags"
        flags.write_text(f"--gtest_output=json:{report}\n--gtest_filter={':'.join(tests)}\n")
        subprocess.run([program, f"--gtest_flagfile={flags}"],
                       env=os.environ | environment, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        if not report.is_file():
            raise SystemExit(f"{program} did not run to its end")
        data = json.loads(report.read_text())
    times, failed = {}, []
    for suite in data["testsuites"]:
        for test in suite["testsuite"]:
            name = f"{suite['name']}.{test['name']}"
            if test["result"] == "SKIPPED":
                continue
            times[name] = float(test["time"].rstrip("s"))
            if "failures" in test:
                failed.append(name)
    return times, failed


def listed(program, filter, environment):
    """Names of all tests of a program."""
    lines = subprocess.run([program, f"--gtest_filter={filter}", "--gtest_list_tests"], check=True,
                           env=os.environ | environment, capture_output=True,
                           text=True).stdout.splitlines()
    names, suite = [], ""
    for line in lines:
        word = line.split("#")[0].strip()
        if line.startswith("  "):
            names.append(suite + word)
        elif word.endswith("."):
            suite = word
    return names


def batches(times, limits=(0.1, 1.0, 5.0, float("inf"))):
    """{program: {test: seconds}} in batches, each of tests of one suite that take about as long;
    quick ones first."""
    plan = {}
    for program, tests in times.items():
        for test, seconds in tests.items():
            tier = next(k for k, limit in enumerate(limits) if seconds <= limit)
            batch = plan.setdefault((tier, program, test.split(".")[0]), Batch(program, [], 0.0))
            batch.tests.append(test)
            batch.seconds += seconds
    return sorted(plan.values(), key=lambda batch: batch.seconds)
