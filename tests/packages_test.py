#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Each header of others that the sources include comes from a package of tools/packages.txt, or from one that such a
package asks for itself: not by way of something that needs it today."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ["/usr/include", "/usr/include/trilinos", "/usr/include/eigen3", "/usr/include/vtk-9.1",
           *pathlib.Path("/usr/lib").glob("*/openmpi/include"), *pathlib.Path("/usr/include").glob("*-linux-gnu")]


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


def included():
    for folder in ("core", "plugins", "tools", "tests"):
        for file in (ROOT / folder).rglob("*.[ch]pp"):
            for header in re.findall(r"^#include <([^>]+)>", file.read_text(), re.M):
                yield header, file.relative_to(ROOT)


def packages_of_headers():
    """{package: (header, file that includes it)}"""
    paths = {}
    for header, file in included():
        for folder in FOLDERS:
            path = pathlib.Path(folder) / header
            if path.is_file():
                paths.setdefault(str(path), (header, file))
                break
    found = {}
    for line in output("dpkg", "-S", *paths).splitlines():
        package, path = line.split(": ", 1)
        found.setdefault(package.split(":")[0].split(",")[0], paths[path])
    return found


def main():
    listed = {line for line in (ROOT / "tools/packages.txt").read_text().split("\n") if line and line[0] != "#"}
    asked_for = re.findall(r"[a-z0-9][a-z0-9.+-]+", output("dpkg-query", "-W", "-f", "${Depends} ", *listed))
    found = packages_of_headers()
    missing = {package: use for package, use in found.items()
               if package not in listed and package not in asked_for and package != "libc6-dev"}
    for package, (header, file) in missing.items():
        print(f"{file} includes <{header}> of {package}, which tools/packages.txt does not name")
    print(f"{len(found)} packages, {len(missing)} not declared")
    return 1 if missing or len(found) < 10 else 0


if __name__ == "__main__":
    sys.exit(main())
