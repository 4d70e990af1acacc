#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Which tests and scenes the changed files can affect, most likely to fail first.

    tools/changed.py BUILD            of what differs from HEAD, or of the last commit where nothing does; SEAM_CHANGED_SINCE=REV
                                      names another base. Writes BUILD/changed/CTestTestfile.cmake and says what it chose.
    tools/changed.py BUILD FILE...    of these files
    tools/changed.py BUILD --learn    keeps how long the tests took that were run last

What takes longest and is furthest from the change is left out where all would take more than SEAM_CHANGED_SECONDS (240), by what
earlier runs took; what that is, it says. `inf` leaves nothing out.

The build folder knows it, once it is up to date: Ninja which object depends on which file and which program holds which
object, CTest which test calls which program. Plugins are loaded at run time: a test that starts `seam` depends on those
that its scenes load. Where the text does not tell which, it counts as depending on all.
"""
import functools
import json
import os
import re
import subprocess
import sys
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# A change in one of these can affect anything.
EVERYTHING = re.compile(r"CMakeLists\.txt|(core|plugins|tests|tools|tools/cli)/CMakeLists\.txt|tools/(cmake/.*|packages\.txt)|core/.*\.in")
SOURCE = re.compile(r"(core|plugins|tools|tests)/.*\.[ch]pp")
UNKNOWN = 3.0  # seconds that a test takes of which nothing is known
# What is run first: what is quick and near.
FORMAT, NEAR, UNIT, KIT, RUN, SCENE, OTHER, STUDY, INSTALL = range(9)


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True, errors="replace").stdout


@functools.cache
def text_of(path):
    try:
        return (ROOT / path).read_text(errors="replace")
    except OSError:
        return ""


@functools.cache
def plugins_with_requirements():
    """{plugin: those that it needs, and itself}; {plugin: types it provides}"""
    needs, provides = {}, {}
    for file in ROOT.glob("plugins/*/CMakeLists.txt"):
        words = re.findall(r"[\w.:]+", text_of(file.relative_to(ROOT)).split("seam_add_plugin(", 1)[-1].split(")", 1)[0])
        after = lambda key: words[words.index(key) + 1:] if key in words else []
        until_key = lambda some: some[: next((i for i, w in enumerate(some) if w.isupper()), len(some))]
        needs[words[0]] = set(until_key(after("REQUIRES"))) | {words[0]}
        provides[words[0]] = [w.split(":")[1] for w in until_key(after("PROVIDES"))]
    while any(needs[n] - needs[p] for p in needs for n in list(needs[p])):
        for p in needs:
            needs[p] |= set().union(*(needs[n] for n in needs[p]))
    return needs, provides


@functools.cache
def plugins_of(text):
    """The plugins that the scenes in a text load; None where that cannot be said."""
    needs, _ = plugins_with_requirements()
    over_all = "configs" in text and re.search(r"""directory_iterator.*\n?.*\.yaml|glob\([^)]*(yaml|\*["'])""", text)
    if over_all or re.search(r"""(\(|\b(seam|argv\[1\]), )"(schema|explain|plugins)\b""", text):
        return None
    found = set()
    for listed in re.findall(r"(?:\b|\\n)plugins\W{1,4}\[([^\]]*)\]", text):
        if re.search(r'["+]', listed):
            return None
        found |= set(re.findall(r"\w+", listed))
    return set().union(*(needs.get(p, {p}) for p in found)) if found else None


@functools.cache
def scenes():
    return sorted(str(p.relative_to(ROOT)) for p in ROOT.glob("configs/**/*.yaml"))


@functools.cache
def data_files():
    """{name: [path]} of the scenes and other data that tests name."""
    found = defaultdict(list)
    for path in [*ROOT.glob("tests/**/*.yaml"), *ROOT.glob("configs/**/*.yaml")]:
        found[path.stem].append(str(path.relative_to(ROOT)))
    return found


def named(text):
    """Scenes that a text names, whatever their folder: "fsi/c01", c01.yaml, "/patch_2d"."""
    words = set(re.findall(r"""(?:["'/ ])([\w.]+?)(?:\.yaml)?(?=["'\s,\]]|$)""", text, re.M))
    return [path for word in words & data_files().keys() for path in data_files()[word] if "configs" in text or not path.startswith("configs/")]


@dataclass
class Test:
    name: str
    command: list
    rank: int
    cases: int = 0  # of Catch2
    scene: bool = False
    why: str = ""


class Build:
    def __init__(self, folder):
        self.folder = Path(folder).resolve()
        self.deps = self._deps()
        self.sources = {o: next((f for f in files if f.endswith(".cpp")), "") for o, files in self.deps.items()}
        self.files = {o: set(files) for o, files in self.deps.items()}
        self.direct, self.order = self._targets()
        self.names = {}  # of test cases, by test of CTest and file
        self.tests = json.loads(output("ctest", "--test-dir", str(self.folder), "--show-only=json-v1"))["tests"]
        with ThreadPoolExecutor() as pool:
            listed = pool.map(lambda t: self._cases(t), self.tests)
        self.cases = {t["name"]: c for t, c in zip(self.tests, listed)}
        self.texts = {}

    def relative(self, path):
        path = os.path.normpath(self.folder / path)
        return os.path.relpath(path, ROOT) if path.startswith(f"{ROOT}/") and not path.startswith(f"{self.folder}/") else ""

    def _deps(self):
        """{object: files, its source first}"""
        deps, now = {}, None
        for line in output("ninja", "-C", str(self.folder), "-t", "deps").splitlines():
            if line.startswith("    "):
                path = self.relative(line.strip())
                if path:
                    now.append(path)
            elif ": #deps" in line:
                now = deps[line.split(":")[0]] = []
        return deps

    def _targets(self):
        """{program or library: what it is made of}, {...: what is built before it}"""
        linked = re.findall(r"^(\S+): C\w+_(?:EXECUTABLE|SHARED|MODULE|STATIC)\w*_LINKER", output("ninja", "-C", str(self.folder), "-t", "targets", "all"), re.M)
        direct, order, now = defaultdict(set), defaultdict(set), None
        for line in output("ninja", "-C", str(self.folder), "-t", "query", *linked).splitlines():
            if not line.startswith(" "):
                now = line.rstrip(":")
            elif line.startswith("  outputs:"):
                now = None
            elif now and line.startswith("    "):
                (order if line.startswith("    || ") else direct)[now].add(line.strip(" |"))
        return direct, order

    def program(self, test):
        """The program of this build that a test of CTest calls."""
        for word in test.get("command", []):
            path = os.path.relpath(word, self.folder)
            if path in self.direct:
                return path
        return ""

    def _cases(self, test):
        """{file: [is a study]} of a test made with Catch2"""
        program = self.program(test)
        if not program.startswith("bin/test_"):
            return {}
        command = test["command"]
        spec = command[[os.path.relpath(w, self.folder) for w in command].index(program) + 1:]
        listed = subprocess.run([self.folder / program, *spec, "-#", "--list-tests"], capture_output=True, text=True, check=False).stdout
        cases, names = defaultdict(list), self.names.setdefault(test["name"], defaultdict(list))
        for case in re.split(r"^  (?=\S)", listed, flags=re.M)[1:]:
            tags = re.sub(r"\s", "", "".join(re.findall(r"^ {6}.*", case, re.M)))
            file = re.search(r"\[#([^\]]+)\]", tags).group(1)
            cases[file].append("[study]" in tags)
            names[file].append(" ".join(re.sub(r"^ {6}.*", "", case, flags=re.M).split()))
        return cases

    def unit(self, program, file):
        """(files that a test file is made of, their folders, its text with that of the scenes it names): with sources of the
        program beside headers that it includes, and theirs."""
        if (program, file) in self.texts:
            return self.texts[program, file]
        objects = {self.sources[o]: o for o in self.direct[program] if self.sources.get(o)}
        left, done, files = [s for s in objects if Path(s).stem == file and s.startswith("tests/")], set(), set()
        while left:
            source = left.pop()
            if source in done:
                continue
            done.add(source)
            files |= self.files[objects[source]]
            left += [s for f in self.files[objects[source]] if f.endswith(".hpp") and (s := f.removesuffix(".hpp") + ".cpp") in objects]
        own = "\n".join(text_of(f) for f in sorted(files) if f.startswith("tests/"))
        self.texts[program, file] = files, {os.path.dirname(f) for f in files}, self.with_scenes(own)
        return self.texts[program, file]

    @staticmethod
    @functools.cache
    def with_scenes(text):
        return text + "\n".join(text_of(path) for path in named(text))


class Selection:
    """What some files can affect."""

    def __init__(self, build, files):
        self.build, self.files = build, set(files)
        self.objects = {o for o, deps in build.files.items() if self.files & deps}
        self.data = [Path(f) for f in files if f.startswith(("tests/", "tools/", "configs/")) and not SOURCE.fullmatch(f) and not f.endswith((".md", "CMakeLists.txt"))]
        self.everything = any(EVERYTHING.fullmatch(f) for f in files)
        # A file that is gone has no objects any more.
        gone = {f for f in files if f.startswith("core/") and f.endswith(".cpp") and not (ROOT / f).exists()}
        self.core = self.everything or bool(gone) or self.touches(next((t for t in build.direct if "libseam_core.so" in t), ""))
        self.seam = self.core or self.touches("bin/seam")
        self.public = bool(self.files & self.public_headers())
        self.plugins = self.affected_plugins()
        self.tests, self.left_out = [], []
        self.total = sum(len(c) for cases in build.cases.values() for c in cases.values())
        self.choose()
        self.tests.sort(key=lambda t: t.rank)

    @staticmethod
    @functools.cache
    def public_headers():
        sys.path.insert(0, str(ROOT / "tools"))
        import headers  # noqa: PLC0415
        return {str(headers.source(name).relative_to(ROOT)) for name in headers.public_headers()}

    def touches(self, target):
        return bool(self.build.direct.get(target, set()) & self.objects)

    def affected_plugins(self):
        """{plugin: its types that are affected; None for all}"""
        _, provides = plugins_with_requirements()
        found = {}
        for plugin, types in provides.items():
            here = f"plugins/{plugin}/"
            if f"{here}CMakeLists.txt" in self.files or any(f.startswith(here) and f.endswith(".cpp") and not (ROOT / f).exists() for f in self.files):
                found[plugin] = None
                continue
            target = f"lib/plugins/libseam_{plugin}.so"
            sources = {self.build.sources[o]: self.build.files[o] for o in self.build.direct[target] if self.build.sources.get(o)}
            changed = {s for s, deps in sources.items() if deps & self.files}
            if changed:
                found[plugin] = self.affected_types(changed, sources, types)
        return found

    @staticmethod
    def affected_types(changed, sources, types):
        """Only the types which these sources register, where that is sure: others reach them by their headers, and what is
        used without being named, as a default, counts as used by all."""
        while True:
            headers = {s.removesuffix(".cpp") + ".hpp" for s in changed}
            more = {s for s, deps in sources.items() if deps & headers and "SEAM_PLUGIN(" not in text_of(s)}
            if more <= changed:
                break
            changed = changed | more
        found = {t for t in types for s in changed if re.search(rf'"\s*,\s*"{t}"|\(registry, "{t}"', text_of(s))}
        is_default = any(f'otherwise("{t}")' in text_of(s) for t in found for s in sources)
        if any("SEAM_PLUGIN(" in text_of(s) for s in changed) or not found or is_default:
            return None
        return found

    def uses(self, text):
        """Whether scenes in this text load what is affected."""
        loaded = plugins_of(text)
        for plugin, types in self.plugins.items():
            if loaded is None:
                return True
            if plugin in loaded and (types is None or re.search(rf"\b({'|'.join(types)})\b", text)):
                return True
        return False

    def names_changed(self, text):
        """Whether a text names a changed file that no compiler reads."""
        return any(re.search(rf"(?<![\w.]){re.escape(f.name)}\b|[\"'/]{re.escape(f.stem)}[\"']", text) for f in self.data)

    def why_unit(self, program, file):
        """(rank, why) of a file of test cases; (None, "") where it is not affected."""
        files, folders, text = self.build.unit(program, file)
        direct, starts = self.build.direct[program], "bin/seam" in self.build.order[program] and "SEAM_COMMAND" in text
        rank = RUN if starts else UNIT
        alike = any(Path(f).stem in file or Path(f).parent.name == Path(program).name.removeprefix("test_") for f in self.files)
        if files & self.files:
            return NEAR, "includes it"
        if any(os.path.dirname(self.build.sources[o]) in folders for o in direct & self.objects if not o.startswith("tests/")):
            return (rank, "its program holds it")
        if self.everything or any(d.startswith("tests/") and self.touches(d) for d in direct | self.build.order[program]):
            return rank, "its program"
        if self.core and any("libseam_core" in d or d.startswith("core/") for d in direct) or any(
                d.startswith("core/") and d in self.objects for d in direct):
            return (NEAR if alike and not starts else rank), "core"
        if starts and (self.seam or self.uses(text)):
            return rank - 0.5 * alike, "starts seam"
        if self.names_changed(text):
            return rank - 0.5, "names it"
        return None, ""

    def script(self, test):
        """(its folder or "", its text with that of what stands beside it)"""
        paths = [os.path.relpath(w, ROOT) for w in test["command"] if w.startswith(f"{ROOT}/") and w.endswith((".py", ".sh"))]
        if not paths:
            return "", ""
        folder = os.path.dirname(paths[0])
        if folder in ("tests", "tools") or (ROOT / folder / "energy_test.cpp").exists():  # among others
            return paths[0], self.build.with_scenes(text_of(paths[0]))
        beside = [str(p.relative_to(ROOT)) for p in sorted((ROOT / folder).rglob("*")) if p.suffix in (".py", ".yaml")]
        return folder + "/", self.build.with_scenes("\n".join(map(text_of, beside)))

    def why_other(self, test):
        """(rank, why) of a test that is a single one."""
        name, program = test["name"], self.build.program(test)
        if name == "public_headers":
            affected = self.everything or self.public or any(f.endswith(".md") or "headers.py" in f or f.endswith("abi.txt") for f in self.files)
            return (FORMAT if affected else None), "public headers, or the guide to them"
        if name == "packages":
            return (OTHER if self.everything or "tools/packages.txt" in self.files or self.objects else None), "sources"
        if name == "out_of_tree":
            mine = self.core or self.public or any(f.startswith(("tests/out_of_tree", "tools/template")) for f in self.files)
            return (INSTALL if mine else None), "what is installed"
        kit = name.removeprefix("conformance_of_") if name.startswith("conformance_of_") else ""
        if kit:
            here = f"plugins/{kit}/conformance/"
            text = "".join(text_of(p.relative_to(ROOT)) for p in sorted((ROOT / here).glob("*.yaml")))
            needs, _ = plugins_with_requirements()
            mine = self.seam or needs[kit] & self.plugins.keys() or self.uses(text) or any(f.startswith(here) for f in self.files)
            return (KIT if mine else None), "conformance"
        folder, text = self.script(test)
        if self.everything or self.touches(program) and program != "bin/seam" or any(f.startswith(folder) for f in self.files if folder):
            return OTHER - (not self.everything), "itself"
        if program == "bin/seam":
            mine = self.seam or self.uses(text)
        else:
            mine = self.core and program
        mine = mine or self.names_changed(text) or self.scene_changed() and re.search(r"glob\(", text)
        return (OTHER if mine else None), "starts seam" if program == "bin/seam" else "core"

    def scene_changed(self):
        return any(f.startswith("configs/") for f in self.files)

    def choose(self):
        build = self.build
        formats = sorted(f for f in self.files if SOURCE.fullmatch(f) and (ROOT / f).exists())
        if formats:
            self.tests.append(Test("format", ["clang-format", "--dry-run", "-Werror", *(str(ROOT / f) for f in formats)], FORMAT))
        for test in build.tests:
            cases, command = build.cases[test["name"]], test.get("command", [])
            labels = next((p["value"] for p in test["properties"] if p["name"] == "LABELS"), [])
            if "slow" in labels:
                continue
            if not cases:
                rank, why = self.why_other(test)
                if rank is not None:
                    self.tests.append(Test(test["name"], command, rank, why=why))
                continue
            program = build.program(test)
            at = [os.path.relpath(w, build.folder) for w in command].index(program) + 1
            for file, studies in cases.items():
                rank, why = self.why_unit(program, file)
                if rank is None:
                    continue
                spec = "".join(command[at:])
                for study in sorted(set(studies)):
                    tag = "" if "[study]" in spec else "[study]" if study else "~[study]"
                    self.tests.append(Test(f"{test['name']}/{file}" + ("/studies" if study else ""), [*command[:at], "-#", f"[#{file}]{spec.replace('~[study]', '')}{tag}"],
                                           STUDY if study else rank, studies.count(study), why=why))
        self.scenes = [s for s in scenes() if not re.search(r"^tier: nightly", text_of(s), re.M)]
        for scene in self.scenes:
            text = text_of(scene)
            if scene in self.files or self.seam or self.uses(text) or any(Path(f).name in text for f in self.files if f.startswith("configs/")):
                self.tests.append(Test(scene.removesuffix(".yaml"), [str(build.folder / "bin/seam"), "verify", str(ROOT / scene), "--quiet"],
                                       NEAR if scene in self.files else SCENE, scene=True))

    def fit(self, seconds):
        """Leaves out what does not fit into so many core seconds, in the order in which tests are run."""
        took, rest, kept = times(self.build.folder), seconds, []
        for test in self.tests:
            cost = took.get(test.name, UNKNOWN)
            # What includes a change or is beside it is run, however long it takes.
            if test.rank <= NEAR or cost <= rest:
                kept.append(test)
                rest -= cost
            else:
                self.left_out.append((test.name, cost))
        self.tests = kept

    def report(self):
        yield f"{len(self.files)} changed files: {', '.join(sorted(self.files)[:4])}{', ...' if len(self.files) > 4 else ''}"
        plugins = [p + (f" ({', '.join(sorted(t))})" if t else "") for p, t in sorted(self.plugins.items())]
        what = ["everything"] if self.everything else ["the core"] * self.core + ["seam"] * (self.seam and not self.core) + [f"plugin {p}" for p in plugins]
        near = [t.name for t in self.tests if t.rank == NEAR]
        yield f"they affect {', '.join(what) or 'no program that scenes need'}; nearest: {', '.join(near[:6]) or 'none'}{', ...' if len(near) > 6 else ''}"
        counts = defaultdict(int)
        for test in self.tests:
            counts[test.name.split("/")[0]] += test.cases
        others = [t.name for t in self.tests if not t.cases and not t.scene]
        by = ", ".join(f"{name} {n}" for name, n in counts.items() if n)
        yield f"{sum(counts.values())} of {self.total} test cases{' (' + by + ')' if by else ''}"
        yield f"{sum(t.scene for t in self.tests)} of {len(self.scenes)} scenes; {', '.join(others) or 'no other test'}"
        if self.left_out:
            yield f"left to `fast` and `scenes`, as time is short: {', '.join(f'{name} ({cost:.0f} s)' for name, cost in self.left_out)}"

    def write(self):
        """As tests of CTest, which counts them and runs several at a time: the first ones cost most, for it."""
        folder = self.build.folder / "changed"
        quote = lambda word: f"[==[{word}]==]"
        lines = []
        for number, test in enumerate(self.tests):
            # Scenes leave results where they run.
            where = folder / "scenes" / test.name if test.scene else self.build.folder / "tests"
            where.mkdir(parents=True, exist_ok=True)
            lines.append(f"add_test({quote(test.name)} {' '.join(map(quote, test.command))})")
            lines.append(f"set_tests_properties({quote(test.name)} PROPERTIES COST {len(self.tests) - number} WORKING_DIRECTORY {quote(where)})")
        folder.mkdir(exist_ok=True)
        (folder / "CTestTestfile.cmake").write_text("\n".join(lines) + "\n")


def times_file(folder):
    return folder / "changed-seconds.json"


@functools.cache
def times(folder):
    """{test or scene: seconds}, as far as they are known."""
    took = {}
    table = folder / "scenes/matrix.json"
    if table.exists():
        took |= {v["scene"].removesuffix(".yaml"): v["seconds"] for v in json.loads(table.read_text())["variants"] if v["seconds"]}
    if times_file(folder).exists():
        took |= json.loads(times_file(folder).read_text())
    return took


def learn(folder):
    log = folder / "changed/changed.log"
    found = re.findall(r"^ *\d+/\d+ Test +#\d+: (\S+) \.* +Passed +([\d.]+) sec", log.read_text(errors="replace") if log.exists() else "", re.M)
    times_file(folder).write_text(json.dumps(times(folder) | {name: float(seconds) for name, seconds in found}, indent=1) + "\n")


def changed_files():
    def git(*words):
        return output("git", "-c", "safe.directory=*", "-C", str(ROOT), *words).splitlines()

    base = os.environ.get("SEAM_CHANGED_SINCE", "")
    for since in [base] if base else ["HEAD", "HEAD~1"]:
        found = git("diff", "--name-only", "--no-renames", since) + git("ls-files", "--others", "--exclude-standard")
        if found:
            return found
    return []


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    if sys.argv[2:] == ["--learn"]:
        return learn(Path(sys.argv[1]).resolve())
    selection = Selection(Build(sys.argv[1]), sys.argv[2:] or changed_files())
    jobs = int(os.environ.get("SEAM_JOBS") or os.cpu_count())
    selection.fit(jobs * float(os.environ.get("SEAM_CHANGED_SECONDS") or 240))
    selection.write()
    print("\n".join(selection.report()))


if __name__ == "__main__":
    main()
