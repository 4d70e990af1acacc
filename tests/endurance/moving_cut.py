#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""2,000 steps of bodies that move through a fluid's mesh: memory, file handles and time per step must not grow.

  tests/endurance/moving_cut.py build/bin/seam [--steps 2000] [--record]

Samples are taken from /proc whenever a hundred steps are done, which is a period of the motion: the cut is the same then.
Time is the processor's. What else runs on the machine makes that longer, too, up to twice where cores share their units:
so it is divided by the time of a short loop that this program runs again and again meanwhile, over its time at the start.
Exit code 1 when something grows.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent / "metamorphic"))

import record  # noqa: E402  the header of records

EVERY = 100
# Factors from the first quarter to the last. What is recorded at every step takes some hundred kilobytes in all.
MEMORY, SECONDS = 1.01, 1.1


def sample(pid):
    """(resident bytes, file handles, seconds of the processor) of a process."""
    status = Path(f"/proc/{pid}/status").read_text()
    memory = next(int(line.split()[1]) * 1024 for line in status.splitlines() if line.startswith("VmRSS"))
    words = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return memory, len(os.listdir(f"/proc/{pid}/fd")), (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def loop():
    """Processor seconds of a fixed piece of work, some milliseconds."""
    start = time.process_time()
    total = 0.0
    for k in range(20000):
        total += k * 0.5
    return time.process_time() - start


def measure(seam, steps, folder):
    """[(steps done, bytes, handles, seconds, seconds of the loop)], one entry for every period; and iterations of each."""
    command = [seam, "run", str(HERE / "moving_cut.yaml"), "--folder", str(folder / "results"), "--quiet", "--no-picture",
               "--set", f"parameters.steps={steps}", "--set", f"parameters.every={EVERY}"]
    process = subprocess.Popen(command, env=os.environ | {"OPENBLAS_NUM_THREADS": "1"}, stdout=subprocess.DEVNULL)
    samples, loops = [], []
    while process.poll() is None:
        done = len(list((folder / "results" / "fields").glob("water-*.vtu"))) - 1
        if done > len(samples):
            try:
                samples.append((EVERY * done, *sample(process.pid), statistics.mean(loops)))
                loops = []
            except (OSError, StopIteration):
                break  # it ended meanwhile
        loops.append(loop())
        time.sleep(0.03)
    if process.wait() != 0:
        raise SystemExit(f"the run ended with exit code {process.returncode}")
    newton = json.loads((folder / "results" / "summary.json").read_text())["newton"]
    counts = [len(step["iterations"]) - 1 for step in newton]
    return samples, [sum(counts[k:k + EVERY]) for k in range(0, len(counts), EVERY)]


def judge(samples):
    """{what: (first quarter's, last quarter's, allowed factor)}; the first period is warming up."""
    steady = samples[1:]
    quarter = max(len(steady) // 4, 1)
    rates = [(b[3] - a[3]) / (b[0] - a[0]) * samples[1][4] / b[4] for a, b in zip(samples, samples[1:])]
    parts = {"resident memory, MB": ([s[1] / 1e6 for s in steady], MEMORY), "file handles": ([float(s[2]) for s in steady], 1.0),
             "processor, ms a step": ([1e3 * r for r in rates], SECONDS)}
    # Of handles the least: one more is open while a file is written.
    middle = {what: min if what == "file handles" else statistics.median for what in parts}
    return {what: (middle[what](v[:quarter]), middle[what](v[-quarter:]), limit) for what, (v, limit) in parts.items()}


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seam", type=Path)
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("--record", action="store_true", help="write docs/results/moving_cut_2000")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        start = time.monotonic()
        samples, iterations = measure(str(options.seam.resolve()), options.steps, Path(folder))
        seconds = time.monotonic() - start
    verdict = judge(samples)
    grows = [what for what, (first, last, limit) in verdict.items() if last > limit * first]
    lines = ["| | steps 200 on | the last ones | allowed |", "|---|---|---|---|"]
    lines += [f"| {what} | {first:.4g} | {last:.4g} | {limit:g} x |" for what, (first, last, limit) in verdict.items()]
    print("\n".join(lines))
    if options.record:
        folder = record.ROOT / "docs" / "results" / "moving_cut_2000"
        folder.mkdir(parents=True, exist_ok=True)
        text = record.header(f"{options.steps:,} steps of a moving cut", "tests/endurance/moving_cut.py build/bin/seam --record", seconds)
        text += ["A cylinder in given motion and a soft body swing through a fluid's mesh, 100 steps a period; samples at the end of "
                 "each period, medians of the first and the last quarter of them (of file handles the least: one more is open while a "
                 "file is written). Processor time over that of a fixed loop that runs meanwhile, since other work on the machine "
                 "lengthens both.", "", *lines, "",
                 "| steps | resident memory, MB | file handles | processor, s | the loop, ms | Newton's iterations |",
                 "|---:|---:|---:|---:|---:|---:|"]
        text += [f"| {done} | {memory / 1e6:.2f} | {handles} | {cpu:.2f} | {1e3 * short:.3f} | {count} |"
                 for (done, memory, handles, cpu, short), count in zip(samples, iterations)]
        (folder / "run.md").write_text("\n".join(text) + "\n")
    print("grows: " + ", ".join(grows) if grows else "nothing grows")
    return 1 if grows else 0


if __name__ == "__main__":
    sys.exit(main())
