#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The public headers: what plugins may include, and what goes into binaries with it.

    tools/headers.py list              their names
    tools/headers.py hash [FILE]       a hash of their tokens, comments left out; written as a C++ header to FILE
    tools/headers.py install FOLDER    copies them
    tools/headers.py check             whether docs/write-a-plugin.md names public headers only, none but plugin.hpp includes
                                       the hash, and core/seam/plugin/abi.txt holds it for the plugin ABI's number
    tools/headers.py record            writes it there, after the number in descriptor.hpp was raised

Public is what ENTRIES name and all that these include. The rest may change at any time.
"""
import hashlib
import pathlib
import re
import shutil
import sys

CORE = pathlib.Path(__file__).resolve().parent.parent / "core"
PLUGINS = CORE.parent / "plugins"
ABI = CORE / "seam/plugin/abi.txt"
GUIDE = CORE.parent / "docs/write-a-plugin.md"
ENTRIES = """
    assembly/domains.hpp base/plugin_fault.hpp constraint/constraint.hpp constraint/node_selection.hpp field/row_law.hpp interface/adjoint.hpp interface/cell_constant.hpp
    interface/interface.hpp linear/block_inverse.hpp linear/linear_solver.hpp mesh/quadrature.hpp physics/body_terms.hpp physics/hyperelastic.hpp
    physics/completes_start.hpp physics/law.hpp physics/physics.hpp physics/potential.hpp physics/regions.hpp physics/stress_law.hpp
    plugin/plugin.hpp plugin/registry.hpp scene/expression.hpp scene/function.hpp scene/parameters.hpp
    scene/schema.hpp state/state_store.hpp term/fad.hpp term/given_functions.hpp term/kernel_term.hpp term/moving_mesh.hpp
    term/symmetric.hpp term/tensor.hpp
""".split()
# Of plugins whose types others can extend: installed as seam/plugins/..., with what they include beside them.
OF_PLUGINS = ["cutfem_fluid/stabilisation.hpp", "mortar_contact/contact_law.hpp"]
GENERATED = {"seam/plugin/fingerprint.hpp", "seam/plugin/headers.hpp"}  # by CMake, where Seam is built

COMMENT_OR_TEXT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
TOKEN = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|\w+|[^\w\s]')


def source(name):
    of_plugin = name.removeprefix("seam/plugins/")
    return CORE / name if of_plugin == name else PLUGINS / of_plugin


def public_headers():
    found = set()
    left = [f"seam/{entry}" for entry in ENTRIES] + [f"seam/plugins/{entry}" for entry in OF_PLUGINS]
    while left:
        name = left.pop()
        if name in found or name in GENERATED:
            continue
        found.add(name)
        for included in re.findall(r'#include "([^"]+)"', source(name).read_text()):
            left.append(included if included.startswith("seam/") else str(pathlib.PurePosixPath(name).parent / included))
    return sorted(found)


def tokens(text):
    def without_comment(match):
        return " " if match.group().startswith("/") else match.group()

    return " ".join(TOKEN.findall(COMMENT_OR_TEXT.sub(without_comment, text)))


def headers_hash():
    digest = hashlib.sha256()
    for name in public_headers():
        # The number stands in a header itself; that it is raised changes nothing else.
        text = re.sub(r"(plugin_abi_m\w+) = \d+", r"\1", tokens(source(name).read_text()))
        digest.update(f"{name}\n{text}\n".encode())
    return digest.hexdigest()[:32]


def abi_number():
    text = (CORE / "seam/plugin/descriptor.hpp").read_text()
    return ".".join(re.search(rf"plugin_abi_{part} = (\d+)", text).group(1) for part in ("major", "minor"))


def check():
    hidden = set(re.findall(r"`(?:core/)?(seam/[\w/]+\.hpp)`", GUIDE.read_text())) - set(public_headers())
    if hidden:
        print(f"{GUIDE.relative_to(CORE.parent)} names {', '.join(sorted(hidden))}, which no installation has: add them to "
              "ENTRIES of tools/headers.py", file=sys.stderr)
        return 1
    # They change with any public header: who includes them is compiled anew each time.
    seen = [str(path.relative_to(CORE)) for path in CORE.rglob("*.hpp")
            if re.search(r'#include "seam/plugin/(fingerprint|headers)\.hpp"', path.read_text())]
    if seen != ["seam/plugin/plugin.hpp"]:
        print(f"{', '.join(seen)} include the fingerprint or the hash of headers; only seam/plugin/plugin.hpp may: take "
              "host_fingerprint() and host_headers() of plugin_info.hpp", file=sys.stderr)
        return 1
    recorded = dict(line.split() for line in ABI.read_text().splitlines() if line and not line.startswith("#"))
    number, found = abi_number(), headers_hash()
    if recorded.get(number) == found:
        return 0
    print(f"The public headers have the hash {found}; {ABI.relative_to(CORE.parent)} has "
          f"{recorded.get(number, 'none')} for the plugin ABI {number}.\nPlugins built before do not fit, or may not: "
          "raise plugin_abi_minor in descriptor.hpp where something was only added at an end, else plugin_abi_major, "
          "then say tools/headers.py record", file=sys.stderr)
    return 1


def record():
    lines = [line for line in ABI.read_text().splitlines() if line.split()[:1] != [abi_number()]]
    ABI.write_text("\n".join([*lines, f"{abi_number()} {headers_hash()}"]) + "\n")
    return 0


def write_hash(file):
    text = f'// Written by tools/headers.py.\n#pragma once\n#define SEAM_HEADERS "{headers_hash()}"\n'
    path = pathlib.Path(file)
    if not path.exists() or path.read_text() != text:
        path.write_text(text)
    return 0


def install(folder):
    for name in public_headers():
        target = pathlib.Path(folder) / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source(name), target)
    return 0


def main(arguments):
    match arguments:
        case ["list"]:
            print("\n".join(public_headers()))
        case ["hash"]:
            print(headers_hash())
        case ["hash", file]:
            return write_hash(file)
        case ["install", folder]:
            return install(folder)
        case ["check"]:
            return check()
        case ["record"]:
            return record()
        case _:
            print(__doc__, file=sys.stderr)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
