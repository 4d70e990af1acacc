#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The commands of a workflow file, as they stand, one script for a shell.

    tests/out_of_tree/workflow.py FILE     of GitHub Actions (.github/workflows/*.yml) or GitLab CI (.gitlab-ci.yml)
"""
import sys

import yaml


def commands(workflow):
    if "jobs" in workflow:
        return [step["run"] for job in workflow["jobs"].values() for step in job["steps"] if "run" in step]
    jobs = [job for job in workflow.values() if isinstance(job, dict) and "script" in job]
    return [line for job in jobs for line in job.get("before_script", []) + job["script"]]


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        found = commands(yaml.safe_load(file))
    if len(found) < 4:
        sys.exit(f"{sys.argv[1]}: {len(found)} commands, expected those that build, test and run the scenes")
    print("\n".join(found))


if __name__ == "__main__":
    main()
