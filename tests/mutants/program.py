# SPDX-License-Identifier: BSD-3-Clause
"""Calls of Seam within limits of time and memory, and what came of them."""
import dataclasses
import os
import resource
import signal
import subprocess
import time

# A single process needs no daemon beside it, and no thread but its own.
ENVIRONMENT = {k: v for k, v in os.environ.items() if not k.startswith("SEAM_")} | {
    "OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_btl": "self", "OPENBLAS_NUM_THREADS": "1"}
MEMORY = 6 << 30
# Processor time; on the wall so many times more, for machines that do other things as well.
PATIENCE = 8
# What a mutant may ask for: the scenes themselves need less than a tenth.
LIMITS = ["--limit", "cells=30000", "--limit", "unknowns=100000", "--limit", "facets=5000", "--limit", "mesher_seconds=20", "--limit", "file_bytes=1e7"]


@dataclasses.dataclass
class Call:
    """What came of a call."""

    code: int
    out: str
    error: str
    seconds: float
    too_long: bool = False

    @property
    def signal(self):
        """The name of the signal that ended it, "" when none did."""
        number = -self.code if self.code < 0 else self.code - 128 if 128 < self.code < 160 else 0
        return signal.Signals(number).name if number in {int(s) for s in signal.Signals} else f"signal {number}" if number else ""


def _limit(seconds):
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 2))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))


def call(command, folder, seconds):
    """Runs a command. @param seconds of processor time that it has"""
    start = time.monotonic()
    process = subprocess.Popen(command, cwd=folder, env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               preexec_fn=lambda: _limit(seconds), start_new_session=True)
    too_long = False
    try:
        out, error = process.communicate(timeout=seconds * PATIENCE)
    except subprocess.TimeoutExpired:
        too_long = True
        os.killpg(process.pid, signal.SIGKILL)  # its own group: what it started ends with it
        out, error = process.communicate()
    return Call(process.returncode, out.decode(errors="replace"), error.decode(errors="replace"), time.monotonic() - start,
                too_long or process.returncode in (-signal.SIGXCPU, 128 + signal.SIGXCPU))
