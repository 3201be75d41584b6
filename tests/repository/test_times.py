"""Gathers what each test took from GoogleTest's reports, slowest first, into a CSV. Names the unit tests
that took more than `slow` seconds of processor time, and fails where one took more than `most`: it
belongs to the long ones, or has to be made quicker.

usage: test_times.py FOLDER_OF_REPORTS CSV"""

import csv
import json
import pathlib
import sys

# Of a unit test [s]. The slowest take 3 to 4 s; beside other work processor times double.
slow = 5.0
most = 20.0


def times_of(report):
    """(test, processor seconds, seconds by the clock) of all that ran."""
    for suite in json.loads(report.read_text())["testsuites"]:
        for test in suite["testsuite"]:
            if test.get("status") == "RUN" and test.get("result") != "SKIPPED":
                yield (f"{suite['name']}.{test['name']}", float(test["processor_seconds"]),
                       float(test["time"].rstrip("s")))


def is_unit(run):
    """Runs of the other labels have names like core.long; shards are numbered: core.1."""
    return all(part.isdigit() for part in run.split(".")[1:])


def gather(folder):
    """(processor seconds, seconds by the clock, run, test), slowest first."""
    rows = [(seconds, clock, report.stem, test) for report in sorted(folder.glob("*.json"))
            for test, seconds, clock in times_of(report)]
    return sorted(rows, reverse=True)


def main():
    folder, table = (pathlib.Path(argument) for argument in sys.argv[1:3])
    rows = gather(folder)
    with table.open("w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["processor_seconds", "clock_seconds", "run", "test"])
        writer.writerows((f"{s:.3f}", f"{clock:.3f}", run, test) for s, clock, run, test in rows)
    named = [(s, test) for s, _, run, test in rows if is_unit(run) and s > slow]
    for seconds, test in named:
        print(f"{test} took {seconds:.1f} s of processor time; a unit test has at most {most:g} s")
    if not rows:
        print(f"no reports in {folder}")
    sys.exit(1 if not rows or any(seconds > most for seconds, _ in named) else 0)


if __name__ == "__main__":
    main()
