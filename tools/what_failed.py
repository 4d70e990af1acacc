#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What failed, from the logs that the stages of tools/test.sh leave: which test, what it says, and how to run it alone.

    tools/what_failed.py BUILD STAGE...     of these stages, in at most 100 lines

Commands are for the root of the source, after `source tools/setup.sh`.
"""
import json
import re
import shlex
import sys
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MOST = 100  # lines in all
LEAST = 5  # lines of a failure, where there are many
NOISE = re.compile(r"\s*$|\s*ok\b|\[\d+/\d+\]|\d+ passed|checks that hold|\s*check +kind +value|===|Randomness|\s*\w+: \d+ *\| *\d+ passed")
BAD = re.compile(r"FAIL|[Ee]rror|wrong|Traceback|[Aa]ssert|\bbad\b|differ|expected|not formatted|refused|grows|signal")


@dataclass
class Failure:
    stage: str
    what: str
    lines: list = field(default_factory=list)
    alone: str = ""

    def text(self, most):
        lines = self.lines[: most - 2]
        if len(lines) < len(self.lines):
            lines[-1:] = [f"... {len(self.lines) - len(lines) + 1} more lines"]
        return [f"{self.stage}: {self.what}", *("    " + line for line in lines), f"    $ {self.alone}"]


def short(text):
    """Paths as seen from the root."""
    return re.sub(rf"{re.escape(str(ROOT))}/|(?<![\w/.])(?:\.\./)+(?=(?:core|plugins|tests|tools)/)", "", text)


def matter(lines):
    """The lines that say what is wrong, with what follows each of them; the last ones where none does."""
    lines = [line for line in lines if not NOISE.match(line)]
    begin = max((i for i, line in enumerate(lines) if line.startswith("Traceback")), default=None)
    if begin is not None:
        return lines[:begin][-3:] + lines[begin:][-8:]
    near = [line for i, line in enumerate(lines) if any(BAD.search(one) for one in lines[max(i - 2, 0):i + 1])]
    return near or lines[-10:]


def quoted(name):
    """A test case as an argument of its program: for Catch2 some characters have a meaning, for the shell others."""
    name = re.sub(r"([\\,])", r"\\\1", name)
    return shlex.quote(name) if re.search(r'[\\$`"!]', name) else f'"{name}"'


def catch_cases(output):
    """[(test case, file:line, lines)], an entry for each assertion that failed."""
    rule, found, case = "-" * 79, [], "?"
    lines = output.splitlines()
    i = 0
    while i < len(lines):
        if lines[i] == rule and rule in lines[i + 1:i + 12]:
            end = lines.index(rule, i + 1)
            # A long name goes on in the next line by four spaces, a section is indented by two.
            head = lines[i + 1:end]
            case = head[0] + "".join(" " + line.strip() for line in head[1:] if line.startswith("    ") and len(head) > 1)
            i = end + 3
            continue
        place = re.match(r"(\S+:\d+): FAILED:", lines[i])
        if place:
            end = i + 1
            while end < len(lines) and lines[end] not in (rule, "=" * 79) and not re.match(r"\S+:\d+: (FAILED|warning)", lines[end]):
                end += 1
            told = [line for line in lines[i + 1:end] if line.strip() and not re.match(r"with expansion:|\.{70}", line)]
            found.append((case, short(place.group(1)), told))
            i = end
            continue
        i += 1
    return found


def of_test(stage, name, command, output, verdict, folder):
    """The failures of one test of CTest."""
    ctest = f"ctest --test-dir {short(str(folder))} -R '^{re.escape(name)}$' -V"
    program = short(command[0]) if command else ""
    if verdict.startswith("Timeout"):
        return [Failure(stage, f"{name}: ended by its time limit", output.splitlines()[-8:], ctest)]
    failures = {}
    for case, place, told in catch_cases(output):
        alone = f"{program} {quoted(case)}" if "bin/test_" in program else ctest
        # Several ranks say the same.
        failures.setdefault((case, place), Failure(stage, f"{name}: \"{case}\" ({place})", told, alone))
    if failures:
        return list(failures.values())
    if name == "format":
        ctest = "clang-format -i " + " ".join(dict.fromkeys(re.findall(r"^(\S+?):\d+:\d+: error", short(output), re.M)))
    if program.endswith("bin/seam"):
        ctest = " ".join(map(shlex.quote, map(short, command)))
    return [Failure(stage, f"{name}: {verdict}" if verdict != "Failed" else name, matter(short(output).splitlines()), ctest)]


def of_ctest(stage, log, folder):
    """Of a log of ctest -V, whose lines begin with the number of their test."""
    text = log.read_text(errors="replace")
    failures = []
    bad = re.findall(r"^ *\d+/\d+ Test +#(\d+): (\S+) \.*\**(?: *)(?:\*\*\*)?(Failed|Timeout|Exception: \w+|Not Run)", text, re.M)
    for number, name, verdict in bad:
        lines = re.findall(rf"^{number}: ?(.*)$", text, re.M)
        command = next((shlex.split(line.removeprefix("Test command: ")) for line in lines if line.startswith("Test command: ")), [])
        output = [line for line in lines if not re.match(r"Test (command|timeout)|Working Directory|Environment variables", line)]
        failures += of_test(stage, name, command, "\n".join(output), verdict, folder)
    if not bad and re.search(r"No tests were found|Errors while running|CMake Error", text):
        failures.append(Failure(stage, "ctest", text.splitlines()[-5:], f"tools/test.sh {stage}"))
    return failures


def of_build(stage, log, folder):
    """Of a log of Ninja: what stands between FAILED: and the next step."""
    failures = []
    where = short(str(folder))
    for target, told in re.findall(r"^FAILED: (\S+).*\n(.*\n(?:(?!\[\d+/|FAILED:|ninja:).*\n)*)", log.read_text(errors="replace"), re.M):
        lines = short(told).splitlines()[1:]  # after the command
        first = next((i for i, line in enumerate(lines) if re.search(r"error|undefined", line)), 0)
        errors = [line for line in lines[first:] if "error" in line or "undefined" in line]
        failures.append(Failure(stage, target, lines[first:first + 8] + errors[1:], f"ninja -C {where} {target}"))
    if not failures:
        text = log.read_text(errors="replace")
        if "ninja: build stopped" in text or "ninja: error" in text or "CMake Error" in text:
            failures.append(Failure(stage, "ninja", matter(text.splitlines()), f"ninja -C {where}"))
    return failures


def of_scenes(stage, folder, build):
    """Of the table that `seam verify --matrix` leaves; of its log where it broke off, or a type is in no scene."""
    log = build / f"{stage}.log"
    told = short(log.read_text(errors="replace")).splitlines() if log.exists() else []
    alone = f"{short(str(build))}/bin/seam verify --matrix configs"
    table = folder / "matrix.json"
    if not table.exists():
        return [Failure(stage, "seam verify --matrix", told[-8:], alone)] if told else []
    failures = []
    for variant in json.loads(table.read_text())["variants"]:
        if variant["verdict"] != "FAIL":
            continue
        name = f'{variant["scene"]}: {variant["variant"] or "as it stands"}'
        lines = [f'{f["what"]}: {line}' for f in variant["findings"] if not f["holds"] for line in f["message"].splitlines()]
        if all(f["holds"] for f in variant["findings"]):
            lines = [f'it passes, though it is declared to fall short: {variant["known"]}']
        command = re.sub(r"\bseam run\b", f"{short(str(build))}/bin/seam run", variant["command"])
        failures.append(Failure(stage, name, [short(line) for line in lines], command or f"{alone} --list --coverage"))
    return failures


def of_stage(build, stage):
    folder = Path(f"{build}-{stage}") if stage in ("sanitize", "fuzz") else build
    failures = []
    if stage in ("build", "changed", "sanitize", "fuzz"):
        if not (folder / "build.ninja").exists() and (folder / "configure.log").exists():
            lines = (folder / "configure.log").read_text(errors="replace").splitlines()
            first = next((i for i, line in enumerate(lines) if "Error" in line), max(len(lines) - 10, 0))
            return [Failure(stage, "CMake", lines[first:first + 12], f"cmake -S . -B {short(str(folder))} -G Ninja")]
        if (folder / "build.log").exists():
            failures += of_build(stage, folder / "build.log", folder)
    log = folder / ("changed/changed.log" if stage == "changed" else f"{stage}.log")
    if stage in ("fast", "install", "sanitize", "fuzz", "changed"):
        if log.exists() and not failures:
            failures += of_ctest(stage, log, folder / "changed" if stage == "changed" else folder)
    elif stage in ("scenes", "nightly"):
        failures += of_scenes(stage, folder / stage, build)
        if stage == "nightly":
            failures += of_stage(build, "metamorphic") + of_stage(build, "endurance")
    elif log.exists() and stage != "build":
        text = short(log.read_text(errors="replace"))
        if stage == "format":
            for file in sorted(set(re.findall(r"^([^:\s]+):\d+:\d+: error:", text, re.M))):
                lines = re.findall(rf"^{re.escape(file)}:\d+:\d+: error:.*\n.*$", text, re.M)
                failures.append(Failure(stage, file, "\n".join(lines).splitlines(), f"clang-format -i {file}"))
        elif re.search(r"FAIL|error|grows:|known$|^Traceback", text, re.M):
            failures.append(Failure(stage, stage, matter(text.splitlines()), f"tools/test.sh {stage}"))
    return failures


def summary(failures):
    """At most MOST lines, shared so that short failures leave room to long ones."""
    if not failures:
        return []
    shown = failures[: (MOST - 2) // LEAST]
    left = failures[len(shown):]
    room = MOST - 1 - bool(left)
    lines = [f"what failed ({len(failures)}):"]
    shares, order = {}, sorted(range(len(shown)), key=lambda i: len(shown[i].lines))
    for done, i in enumerate(order):
        shares[i] = min(len(shown[i].lines) + 2, room // (len(order) - done))
        room -= shares[i]
    for i, failure in enumerate(shown):
        lines += failure.text(shares[i])
    if left:
        counts = {stage: sum(f.stage == stage for f in left) for stage in dict.fromkeys(f.stage for f in left)}
        lines.append("left out: " + ", ".join(f"{n} more of {stage}" for stage, n in counts.items()))
    return lines


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    build = Path(sys.argv[1]).resolve()
    failures = []
    for stage in sys.argv[2:]:
        failures += of_stage(build, stage) or [Failure(stage, "nothing in its logs says what", [], f"tools/test.sh {stage}")]
    print("\n".join(line[:300] for line in summary(failures)))


if __name__ == "__main__":
    main()
