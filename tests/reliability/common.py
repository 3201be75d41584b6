"""What the scripts of this folder share. They are run by `./dev reliability`, from the root."""

import os
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parents[2]
sections = root / "tests/reliability/sections"
ticks = os.sysconf("SC_CLK_TCK")  # of processor time, a second


def say(text):
    print(f"reliability: {text}", file=sys.stderr, flush=True)


def write_section(name, text):
    """Makes `text` a section of tests/RELIABILITY.md; the names put them in order."""
    sections.mkdir(exist_ok=True)
    (sections / f"{name}.md").write_text(text.strip() + "\n")
    say(f"written: tests/reliability/sections/{name}.md")


def table(head, rows):
    """Rows of cells as a table of Markdown; columns of numbers are flush right."""
    right = [all(re.match(r"[-0-9]", str(row[k])) for row in rows) for k in range(len(head))]
    lines = [head, ["--:" if r else "---" for r in right], *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines) + "\n"


def number(n):
    """1234567 as 1,234,567."""
    return f"{n:,}"


def build(preset, *targets):
    say(f"building {preset}: {' '.join(targets) or 'everything'}")
    configure = ["cmake", "--preset", preset]
    make = ["cmake", "--build", "--preset", preset, "-j", str(len(os.sched_getaffinity(0)))]
    if targets:
        make += ["--target", *targets]
    for command in (configure, make):
        subprocess.run(command, cwd=root, check=True, stdout=sys.stderr)


def processor_seconds(pid):
    """User and system time of a process that runs [s]."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / ticks


def fail(text):
    say(text)
    sys.exit(1)
