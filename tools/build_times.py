#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What it costs to build Seam, in core seconds: all of it, and what is built anew after a header was touched.

    tools/build_times.py FOLDER            configures FOLDER, builds everything in it from nothing, prints a table
    tools/build_times.py FOLDER --again    only the table, of a folder that was built so
    tools/build_times.py A B --again       the tables of two folders side by side, as before and after a change

Core seconds are what the compiler used, user and system, measured where each file is compiled: other work on the machine
changes them little. The compiler cache is left out. What depends on what is the build's own knowledge (ninja -t deps).
"""
import argparse
import collections
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
LOG = "compilations.jsonl"
TOUCHED = """
    scene/parameters.hpp plugin/registry.hpp term/fad.hpp state/state_store.hpp field/field.hpp assembly/element.hpp
    interface/interface.hpp physics/physics.hpp solve/problem.hpp cut/cut_mesh.hpp term/kernel_term.hpp plugin/plugin_info.hpp
""".split()
KERNELS = """
    solid/kernels.hpp solid/spring_kernels.hpp cutfem_fluid/kernels.hpp nitsche_fsci/contact_kernels.hpp
    nitsche_fsci/fluid_sided.hpp poroelasticity/kernels.hpp
""".split()


def launch(log, command):
    """Runs the compiler in place of CMake and notes what it used."""
    code = subprocess.run(command).returncode
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    if "-o" in command:
        entry = {"object": command[command.index("-o") + 1], "seconds": used.ru_utime + used.ru_stime}
        with open(log, "a") as file:
            file.write(json.dumps(entry) + "\n")
    return code


def build(folder, jobs):
    if (folder / "build.ninja").exists():
        sys.exit(f"{folder} has been configured already: name a new folder, or say --again for its table")
    folder.mkdir(parents=True, exist_ok=True)
    launcher = f"{sys.executable};{pathlib.Path(__file__).resolve()};--launch;{folder / LOG}"
    subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", f"-DCMAKE_CXX_COMPILER_LAUNCHER={launcher}"],
                   check=True, stdout=subprocess.DEVNULL)
    start = time.time()
    with open(folder / "build.log", "w") as log:
        subprocess.run(["ninja", "-C", folder, "-j", str(jobs)], check=True, stdout=log)
    (folder / "wall_seconds").write_text(f"{time.time() - start:.0f}")


class Measured:
    """Seconds and headers of each object of a folder."""

    def __init__(self, folder):
        if not (folder / "wall_seconds").exists():
            sys.exit(f"{folder} was not built to its end by this tool: remove it, and build it without --again")
        self.seconds = {}
        for line in (folder / LOG).read_text().splitlines():
            entry = json.loads(line)
            self.seconds[entry["object"]] = entry["seconds"]
        self.headers = collections.defaultdict(set)
        found = subprocess.run(["ninja", "-C", folder, "-t", "deps"], capture_output=True, text=True, check=True).stdout
        current = None
        for line in found.splitlines():
            if match := re.match(r"(\S+): #deps", line):
                current = match.group(1)
            elif line.strip():
                self.headers[current].add(line.strip())

    def group(self, name):
        return sum(s for o, s in self.seconds.items() if group_of(o) == name)

    def first_result(self):
        """Of the command, the plugins and the pictures."""
        return sum(s for o, s in self.seconds.items() if re.match(r"core/|plugins/|tools/(CMakeFiles/seam[.]dir|picture)/", o))

    def touching(self, header):
        """Core seconds, and the number of files, that are compiled anew."""
        objects = [o for o in self.seconds if any(h.endswith(header) for h in self.headers[o])]
        return sum(self.seconds[o] for o in objects), len(objects)


def group_of(path):
    first = path.split("/")[0]
    if first == "tests" and re.search(r"plugins_bad|/plugin/", path):
        return "plugins of tests"
    return first if first in ("core", "plugins", "tests", "tools") else "rest"


def table(folders):
    all_measured = [Measured(folder) for folder in folders]
    rows = [["core seconds", *(folder.name for folder in folders)]]
    rows.append(["seconds on the clock", *((folder / "wall_seconds").read_text() for folder in folders)])
    rows.append(["clean build", *(f"{sum(m.seconds.values()):.0f}" for m in all_measured)])
    for name in ("core", "plugins", "tools", "tests", "plugins of tests", "rest"):
        rows.append([f"of it {name}", *(f"{m.group(name):.0f}" for m in all_measured)])
    rows.append(["what `tools/run.sh` builds", *(f"{m.first_result():.0f}" for m in all_measured)])
    for header in [f"core/seam/{h}" for h in TOUCHED] + [f"plugins/{h}" for h in KERNELS]:
        rows.append([f"touched `{header}`", *("{:.0f} in {} files".format(*m.touching(header)) for m in all_measured)])
    last = all_measured[-1]
    for name in sorted(last.seconds, key=last.seconds.get, reverse=True)[:12]:
        source = re.sub(r"CMakeFiles/[^/]+\.dir/|\.o$", "", name)
        rows.append([f"`{source}`", *(f"{m.seconds.get(name, 0):.1f}" for m in all_measured)])
    print("| " + " | ".join(rows[0]) + " |\n|---|" + "---:|" * len(folders))
    for row in rows[1:]:
        print("| " + " | ".join(row) + " |")


def main():
    if sys.argv[1:2] == ["--launch"]:
        return launch(sys.argv[2], sys.argv[3:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="+", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("--again", action="store_true", help="only the table")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    if not options.again:
        if len(options.folder) != 1:
            parser.error("one folder is built at a time")
        build(options.folder[0], options.jobs)
    table(options.folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
