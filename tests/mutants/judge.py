# SPDX-License-Identifier: BSD-3-Clause
"""What must not happen, by rules that do not come from Seam's own reader: a reader of YAML 1.2, the JSON Schema, what files hold."""
import csv
import io
import json
import re
import subprocess

import jsonschema
from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

# Words of the language or of libraries: no message for those who write scenes.
INTERNAL = re.compile(r"std::|basic_string|vector::|_M_\w|bad_alloc|bad_any|bad_optional|what\(\)|terminate called|Sanitizer|runtime error:|boost::|YAML::|"
                      r"nlohmann|json\.exception|Teuchos|Tpetra|Kokkos|Belos|exprtk|\bsto[id]\b|map::at|Assertion|core dumped|Segmentation|"
                      r"\[\w+ \* ?\]|0x[0-9a-f]{7,}|\.[ch]pp[:(]\d+|vtk[A-Z]\w+ \(|no member named|locale::|iostream error")
PLACE = re.compile(r"[^\s:]+:\d+(:\d+)?: (error|warning)")
# Files of a scene that end here are as good as whole ones: see docs/write-a-scene.md.
DEEPEST, LONGEST = 24, 1 << 20
BROKEN_INPUT, FAILED, PLUGIN_FAILED = 2, 1, 3


class Rules:
    """Judges calls."""

    def __init__(self, seam):
        schema = json.loads(subprocess.run([seam, "schema"], check=True, stdout=subprocess.PIPE).stdout)
        self.validator = jsonschema.Draft7Validator(schema)

    def refusal_due(self, data):
        """Why a scene has to be refused, "" where the rules know of no reason."""
        if len(data) > LONGEST:
            return "more than 1 MiB"
        try:
            text = data.decode()
        except UnicodeDecodeError:
            return "no UTF-8"
        if re.search(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]", text):
            return "control characters"
        text = text.replace("%YAML 1.1", "%YAML 1.2")  # Seam reads the one as the other
        # Tabs are fine but where they indent, which this reader does not know.
        text = re.sub(r"(?<=\S)[ \t]+", " ", re.sub(r"(?m)[ \t]+$|^[ \t]+(?=#)", "", text))
        try:
            why = self._forbidden(text)
            return why or self._by_schema(text)
        except (YAMLError, ValueError) as error:
            return "no YAML: " + " ".join(str(error).split())[:150]
        except RecursionError:
            return "nested deeply"

    @staticmethod
    def _forbidden(text):
        depth = documents = 0
        for event in YAML(typ="safe", pure=True).parse(io.StringIO(text)):
            name = type(event).__name__
            documents += name == "DocumentStartEvent"
            depth += name in ("SequenceStartEvent", "MappingStartEvent")
            depth -= name in ("SequenceEndEvent", "MappingEndEvent")
            if depth > DEEPEST:
                return "nested deeply"
            if getattr(event, "anchor", None):
                return "anchor or alias"
            if getattr(event, "tag", None) not in (None, "!"):
                return "tag"
        return "several documents" if documents > 1 else ""

    def _by_schema(self, text):
        reader = YAML(typ="safe", pure=True)
        error = jsonschema.exceptions.best_match(self.validator.iter_errors(without_open_keys(reader.load(text))))
        return "schema: " + ".".join(str(k) for k in error.absolute_path) + ": " + error.message[:150] if error else ""


def without_open_keys(value):
    """Keys without a value are as if they were not there."""
    if isinstance(value, dict):
        return {key: without_open_keys(child) for key, child in value.items() if child is not None}
    return [without_open_keys(child) for child in value] if isinstance(value, list) else value


def told(call):
    """What any call must not do."""
    if call.too_long:
        return "does not end"
    if call.signal:
        return "ended by " + call.signal
    if call.code not in (0, FAILED, BROKEN_INPUT, PLUGIN_FAILED, 124):
        return f"exit code {call.code}"
    words = INTERNAL.search(call.error + call.out)
    if words:
        return "internal words: " + words.group()
    if call.code in (BROKEN_INPUT, PLUGIN_FAILED) and "error:" not in call.error:
        return "no error told"
    return ""


def has_place(call):
    """Whether an error names file and line."""
    return bool(PLACE.search(call.error))


def check(call, rules, data):
    """A check of a scene. @returns what is bad, "" when nothing is"""
    bad = told(call)
    if bad:
        return bad
    if call.code == FAILED and "memory" not in call.error:
        return "a check that fails instead of refusing"
    if call.code == 124:
        return "a check without a limit ends by it"
    due = rules.refusal_due(data) if call.code == 0 else ""
    return "accepted: " + due if due else ""


def run(call, checked, results):
    """A run of a scene that was checked before. @param checked the check @param results its folder"""
    bad = told(call)
    if bad:
        return bad
    if checked.code == 0 and call.code in (BROKEN_INPUT, PLUGIN_FAILED):
        return "the check accepted what the run refuses"
    # What nothing acts on stays where it is, also where nothing holds it, and the run fails where something does: only the check looks before.
    unheld = "is not held" in checked.error
    if checked.code in (BROKEN_INPUT, PLUGIN_FAILED) and call.code not in (BROKEN_INPUT, PLUGIN_FAILED) and not unheld:
        return "the run begins what the check refuses"
    if call.code == FAILED and "error:" not in call.error and "FAIL" not in call.out and "fail" not in call.out:
        return "fails without saying why"
    return left(results) if call.code == 0 else ""


def left(results):
    """What is wrong with what a run left that came to its end."""
    try:
        summary = json.loads((results / "summary.json").read_text(), parse_constant=lambda word: 1 / 0)
        record = json.loads((results / "run.json").read_text())
        rows = list(csv.reader((results / "series.csv").open()))
    except (OSError, ValueError, ArithmeticError) as error:
        return f"results are not complete: {error}"
    for name, status in (("summary.json", summary["status"]), ("run.json", record["status"])):
        if status not in ("finished", "stopped"):
            return f"{name}: status {status}"
    if any((results / name).exists() for name in ("run.lock",)) or list(results.rglob("*.tmp")):
        return "files are left over"
    return series(rows) or results_of(summary, rows[0])


def may_be_infinite(name):
    """Least numbers of contact are infinite where nothing touches or is opposite."""
    return "gap" in name or "effective_pressure" in name


def series(rows):
    """What is wrong with a table."""
    if len(rows) < 2 or any(len(row) != len(rows[0]) for row in rows):
        return "series.csv: rows that are missing or of another length"
    times = [float(row[0]) for row in rows[1:]]
    if any(not b > a for a, b in zip(times, times[1:])):
        return "series.csv: times that do not grow"
    for name, value in zip(rows[0], rows[-1]):
        number = float(value)
        if number != number or (abs(number) == float("inf") and not may_be_infinite(name)):
            return f"series.csv: {name} is {value} at the end"
    return ""


def results_of(summary, columns):
    """Series and errors at the end that are no numbers; statistics may be infinite."""
    for name, value in summary["results"].items():
        judged = name in columns or name.endswith((".l2", ".h1"))
        if value is None and judged and not may_be_infinite(name) and summary["status"] == "finished":
            return f"summary.json: {name} is no number"
    return ""
