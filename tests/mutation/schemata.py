"""A copy of the source in which every change of mutants.toml can be switched on at run time.

Compiling the kernels takes minutes, so that a hundred mutants are not built one by one: all are
compiled into one program, each as `(grainfield_mutant == 17 ? (changed) : (original))`, and the
environment variable GRAINFIELD_MUTANT tells which one is on.
"""

import dataclasses
import os
import pathlib
import re
import subprocess
import tomllib

SWITCH = "GRAINFIELD_MUTANT"
MARKED = re.compile(r"@(v?)\[(.*?)@\|(.*?)@\]", re.DOTALL)
DECLARATION = "extern int grainfield_mutant;\n"
DEFINITION = f"""#include <cstdlib>

extern int grainfield_mutant;
int grainfield_mutant = [] {{
    const char* number = std::getenv("{SWITCH}");
    return number == nullptr ? 0 : std::atoi(number);
}}();
"""


class ListError(Exception):
    """The list of mutants does not fit the source."""


@dataclasses.dataclass
class Mutant:
    number: int
    file: str
    original: str
    changed: str
    vector: bool  # its value is a Vec3
    begin: int  # of the original in the file
    end: int
    line: int
    equivalent: str | None  # why no test can tell it from the original


def spaced(text):
    """A pattern that finds the text with any white space between its words."""
    words = re.findall(r"\w+|[^\w\s]", text)
    return r"\s*".join(re.escape(word) for word in words)


def one_line(text):
    return " ".join(text.split())


def locate(source, number, file, entry, reason):
    marks = list(MARKED.finditer(entry))
    if len(marks) != 1:
        raise ListError(f"mutant {number}: {len(marks)} changes are marked, not one")
    vector, original, changed = marks[0].groups()
    before, after = entry[: marks[0].start()], entry[marks[0].end() :]
    pattern = r"\s*".join(
        part for part in (spaced(before), f"(?P<original>{spaced(original)})", spaced(after)) if part
    )
    found = list(re.finditer(pattern, source))
    if len(found) != 1:
        raise ListError(f"mutant {number}: its text stands in {file} {len(found)} times, not once")
    begin, end = found[0].span("original")
    return Mutant(number, file, source[begin:end], changed.strip(), bool(vector), begin, end,
                  source.count("\n", 0, begin) + 1, reason)


def read_list(path, root):
    """All mutants, by number."""
    tables = tomllib.loads(path.read_text())
    reasons = tables.pop("equivalent")
    mutants = {}
    for file, entries in tables.items():
        source = (root / file).read_text()
        for key, entry in entries.items():
            number = int(key)
            if number <= 0 or number in mutants:
                raise ListError(f"mutant {number}: the number is not new")
            mutants[number] = locate(source, number, file, entry, reasons.pop(key, None))
    if reasons:
        raise ListError(f"no such mutants: {', '.join(reasons)}")
    return dict(sorted(mutants.items()))


def switched(text, here):
    """`text` with the choice between it and the mutants `here`, which all change just this."""
    for m in here:
        on = f"grainfield_mutant == {m.number}"
        if m.original.endswith(";"):
            text = f"{{ if ({on}) {{ {m.changed} }} else {{ {text} }} }}"
        elif m.vector:
            vec = "::grainfield::Vec3"
            text = f"({on} ? {vec}({m.changed}) : {vec}({text}))"
        else:
            text = f"({on} ? ({m.changed}) : ({text}))"
    return text


def mutated(source, mutants):
    """The source with all mutants of the file in it. One may lie within the original of another."""
    spans = {}
    for m in mutants:
        spans.setdefault((m.begin, m.end), []).append(m)
    order = sorted(spans, key=lambda span: (span[0], -span[1]))

    def render(begin, end, inner):
        out, at = "", begin
        while inner:
            span = inner.pop(0)
            if span[0] < at or span[1] > end:
                raise ListError(f"mutant {spans[span][0].number} overlaps another")
            within = []
            while inner and inner[0][0] < span[1]:
                within.append(inner.pop(0))
            out += source[at : span[0]] + switched(render(*span, within), spans[span])
            at = span[1]
        return out + source[at:end]

    return DECLARATION + render(0, len(source), order)


def with_few_targets(source):
    """Without AVX-512: the kernels are one text for all instruction sets, and AVX2 and plain code
    compile in half the time."""
    return re.sub(r"(#define HWY_DISABLED_TARGETS \(.*?)\)", r"\1 | HWY_AVX3)", source)


def write_if_new(path, data):
    if path.is_file() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def make_tree(root, tree, mutants):
    """Copies the repository's files to `tree`; those that have not changed are left alone, for the
    sake of what is built from them."""
    names = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                           cwd=root, check=True, capture_output=True, text=True).stdout.split("\0")
    by_file = {}
    for m in mutants.values():
        by_file.setdefault(m.file, []).append(m)
    wanted = {"kernels/mutant.cpp"}
    write_if_new(tree / "kernels/mutant.cpp", DEFINITION.encode())
    for name in names:
        path = root / name
        if not name or name.startswith("bench/results/") or not path.is_file():
            continue
        data = path.read_bytes()
        if name in by_file:
            data = mutated(data.decode(), by_file[name]).encode()
        if name.endswith(".cpp") and b"HWY_TARGET_INCLUDE" in data:
            data = with_few_targets(data.decode()).encode()
        write_if_new(tree / name, data)
        os.chmod(tree / name, path.stat().st_mode)
        wanted.add(name)
    for path in [p for p in tree.rglob("*") if p.is_file()]:
        if str(path.relative_to(tree)) not in wanted:
            path.unlink()


if __name__ == "__main__":
    here = pathlib.Path(__file__).resolve()
    print(len(read_list(here.parent / "mutants.toml", here.parents[2])), "mutants, each in its place")
