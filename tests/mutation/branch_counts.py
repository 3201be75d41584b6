"""Lines and branches that a test run took, from what gcov counted.

What counts as a branch, and as covered:

- A template is compiled many times, the vector kernels for several instruction sets and every
  combination of features. A branch of a line of source is covered if some instantiation took it.
  Where instantiations differ in how many branches they have there (`if constexpr`), those with the
  most stand for the line.
- A function that the compiler inlined in many places, a destructor in a header or one of the vector
  kernels, has the branches of all its copies in one row of gcov's. Copies of a branch are one
  branch: a line whose branches are a multiple of twice its conditions has those of one copy. In the
  vector kernels, where the copies differ, any line has.
- Branches of a statement in which the source has no condition (`if`, a loop, `?`, `&&`, `||`,
  `switch`) are the compiler's own, in destructors and for static variables, and do not count.
- The compiler gives every call that may throw a branch to where the exception goes. These, and
  their other halves, are no branches of the source and do not count (gcov marks them).
- Error exits of the system do not count: the branches of a statement in which a call's failure is
  told by `errno`, `std::error_code`, `ferror`, `bad()` or a negative result of HDF5. tests/faults
  makes such calls go wrong one after the other.
"""

import collections
import concurrent.futures
import dataclasses
import json
import pathlib
import re
import subprocess

SYSTEM = re.compile(r"\berrno\b|\berror_text\(|\bstrerror\(|\berror_code\b|\bferror\(|\.bad\(\)"
                    r"|\bif \(error\)|\bH5\w+\(")
CONDITION = re.compile(r"\b(?:if|for|while|switch|case)\b|\?|&&|\|\|")
NO_CONDITION = re.compile(r"\bif constexpr\b|\"(?:[^\"\\]|\\.)*\"|\w&&|&& *[,)>]|//.*")
LONGEST_STATEMENT = 6  # lines


@dataclasses.dataclass
class Line:
    count: int = 0
    # By number of branches in an instantiation: how often each was taken in any of them.
    branches: dict = dataclasses.field(default_factory=dict)

    def add(self, count, branches):
        self.count = max(self.count, count)
        if branches:
            known = self.branches.setdefault(len(branches), [0] * len(branches))
            for k, taken in enumerate(branches):
                known[k] += taken

    def merged(self, conditions, differ):
        """How often each branch of so many conditions was taken, in any of its copies."""
        taken = self.branches[max(self.branches)] if self.branches else []
        if len(taken) <= 2:
            return taken
        if conditions > 0 and len(taken) % (2 * conditions) == 0:
            base = 2 * conditions
        elif differ:
            base = 2
        else:
            return taken
        return [sum(taken[k::base]) for k in range(base)]


def real_branches(branches):
    """How often each was taken, without the pairs whose second half is the way of an exception."""
    kept, k = [], 0
    while k < len(branches):
        if k + 1 < len(branches) and branches[k]["fallthrough"] and branches[k + 1]["throw"]:
            k += 2
            continue
        if not branches[k]["throw"]:
            kept.append(branches[k]["count"])
        k += 1
    return kept


def of_object(counts, folder):
    """What gcov says about one object file."""
    done = subprocess.run(["gcov", "--json-format", "--stdout", "--branch-probabilities", counts],
                          cwd=folder, check=True, capture_output=True, text=True)
    return [json.loads(text) for text in done.stdout.splitlines() if text.startswith("{")]


def collect(build, root, folders, jobs):
    """{file: {line number: Line}} of the files in `folders`."""
    files = collections.defaultdict(lambda: collections.defaultdict(Line))
    objects = sorted(build.rglob("*.gcda"))
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for reports in pool.map(lambda counts: of_object(counts, build), objects):
            for file in (f for report in reports for f in report["files"]):
                path = pathlib.Path(build, file["file"]).resolve()
                if not path.is_relative_to(root):
                    continue
                name = str(path.relative_to(root))
                if name.split("/")[0] not in folders:
                    continue
                for line in file["lines"]:
                    files[name][line["line_number"]].add(line["count"],
                                                         real_branches(line["branches"]))
    return files


def conditions(source, number):
    """How many conditions the source has in this line; and in its statement up to here."""
    code = NO_CONDITION.sub("", source[number - 1])
    here = total = len(CONDITION.findall(code))
    for line in reversed(source[max(0, number - LONGEST_STATEMENT) : number - 1]):
        code = NO_CONDITION.sub("", line).rstrip()
        if not code or code[-1] in ";{}":
            break
        total += len(CONDITION.findall(code))
    return here, total


def asks_the_system(source, number):
    """Whether the statement that begins in this line tells a failure of the system."""
    text = ""
    for line in source[number - 1 : number - 1 + LONGEST_STATEMENT]:
        code = line.split("//")[0]
        text += code
        if ";" in code or "{" in code:
            break
    return SYSTEM.search(text) is not None


@dataclasses.dataclass
class Tally:
    lines: int = 0
    lines_taken: int = 0
    branches: int = 0
    branches_taken: int = 0
    system: int = 0  # branches left out as error exits of the system

    def __iadd__(self, other):
        for field in dataclasses.fields(self):
            name = field.name
            setattr(self, name, getattr(self, name) + getattr(other, name))
        return self

    def share(self):
        return self.branches_taken / self.branches if self.branches else 1.0


def tally(name, source, lines):
    """Of one file; and the lines with a branch that was never taken, with how many."""
    copies_differ = name.startswith("kernels/vector/") or name.startswith(
        ("randomfield/generators/halving_rows", "randomfield/generators/row_sums"))
    sums, missing = Tally(), {}
    for number, line in sorted(lines.items()):
        sums.lines += 1
        sums.lines_taken += line.count > 0
        here, in_statement = conditions(source, number)
        branches = line.merged(here, copies_differ) if in_statement else []
        if asks_the_system(source, number):
            sums.system += len(branches)
            continue
        taken = sum(count > 0 for count in branches)
        sums.branches += len(branches)
        sums.branches_taken += taken
        if taken < len(branches):
            missing[number] = len(branches) - taken
    return sums, missing
