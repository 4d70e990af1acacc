#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every kind of type that a plugin can add has a heading in docs/write-a-plugin.md, and under it an example that the install
stage builds. And the plugins of fluid and solid know nothing of the pores that a third one adds to them.

Usage: plugin_kinds_test.py <seam>
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def sections():
    """Kind of a heading to the text under it."""
    text = (ROOT / "docs/write-a-plugin.md").read_text()
    return {match[1]: match[2] for match in re.finditer(r"^## [^\n]*`(\w+)`\n(.*?)(?=^## |\Z)", text, re.M | re.S)}


def speak_of_pores():
    """Files of the plugins of fluid and solid that do."""
    return [path.relative_to(ROOT) for name in ("cutfem_fluid", "solid") for path in sorted((ROOT / "plugins" / name).rglob("*"))
            if path.is_file() and "poro" in path.read_text().lower()]


def main(seam):
    listed = subprocess.run([seam, "plugins", "--kinds"], check=True, capture_output=True, text=True).stdout
    kinds = {line.split()[0] for line in listed.splitlines() if line[:1].strip()}
    built = (ROOT / "tests/out_of_tree.sh").read_text()
    found = sections()
    wrong = [f"no heading names the kind `{kind}`" for kind in sorted(kinds - set(found))]
    wrong += [f"a heading names `{kind}`, which is no kind" for kind in sorted(set(found) - kinds)]
    for kind in sorted(kinds & set(found)):
        folders = {"/".join(path.split("/")[:3] if path.startswith("tests/") else path.split("/")[:2])
                   for path in re.findall(r"\]\(\.\./((?:tests/out_of_tree|tools/template)[^)]*)\)", found[kind])}
        examples = [folder for folder in sorted(folders)
                    if f'"$source/{folder}"' in built and f"{kind}:" in (ROOT / folder / "CMakeLists.txt").read_text()]
        if not examples:
            wrong.append(f"under the heading of `{kind}` no link leads to an example of it that tests/out_of_tree.sh builds")
    wrong += [f"{path} speaks of pores, which are no matter of its plugin" for path in speak_of_pores()]
    print("\n".join(wrong) or f"{len(kinds)} kinds, each with a heading and an example")
    return 1 if wrong or not kinds else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
