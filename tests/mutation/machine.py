"""Where and when a figure was measured."""

import datetime
import pathlib
import subprocess


def cpu():
    """The processor's name as Linux has it."""
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return "unknown processor"


def commit(root):
    """The commit; with a plus sign if files differ from it."""
    def git(*words):
        return subprocess.run(["git", *words], cwd=root, check=True, capture_output=True,
                              text=True).stdout.strip()
    return git("rev-parse", "--short", "HEAD") + ("+" if git("status", "--porcelain") else "")


def stamp(root):
    return f"{datetime.date.today().isoformat()}, commit {commit(root)}, {cpu()}"
