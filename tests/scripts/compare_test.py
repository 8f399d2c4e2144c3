#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: The SLAMBench authors
"""Tests of bench/compare."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def entry(name, time, unit="us", **more):
    return {"run_name": f"{name}/real_time", "run_type": "iteration", "real_time": time,
            "time_unit": unit, **more}


class Compare(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, *entries):
        path = self.folder / name
        path.write_text(json.dumps({"context": {"cpu": f"cpu of {name}"},
                                    "benchmarks": list(entries)}))
        return path

    def compare(self, *arguments):
        return subprocess.run([sys.executable, ROOT / "bench/compare", *map(str, arguments)],
                              capture_output=True, text=True, check=False)

    def test_the_same_is_no_slower(self):
        run = self.write("a", entry("track/serial/grid", 100))
        outcome = self.compare(run, run)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        self.assertRegex(outcome.stdout, r"track/serial/grid +100 us +100 us +1\.00\n")
        self.assertIn("cpu of a", outcome.stdout)

    def test_what_is_slower_is_listed(self):
        before = self.write("a", entry("track", 100), entry("reduce", 100), entry("solve", 100))
        now = self.write("b", entry("track", 0.13, "ms"), entry("reduce", 124), entry("solve", 70))
        outcome = self.compare(before, now)
        self.assertEqual(outcome.returncode, 5)
        self.assertRegex(outcome.stdout, r"track +100 us +130 us +1\.30  slower")
        self.assertRegex(outcome.stdout, r"reduce +100 us +124 us +1\.24\n")
        self.assertRegex(outcome.stdout, r"solve +100 us +70 us +0\.70  faster")
        self.assertTrue(outcome.stdout.endswith("times the baseline: track\n"))
        self.assertEqual(self.compare("--threshold", "1.4", before, now).returncode, 0)

    def test_the_fastest_repetition_counts(self):
        before = self.write("a", entry("track", 100), entry("track", 90))
        now = self.write("b", entry("track", 300), entry("track", 99),
                         entry("track", 1, run_type="aggregate"))
        outcome = self.compare(before, now)
        self.assertEqual(outcome.returncode, 0)
        self.assertRegex(outcome.stdout, r"track +90 us +99 us +1\.10")

    def test_new_and_gone_are_named(self):
        outcome = self.compare(self.write("a", entry("old", 1)), self.write("b", entry("young", 1)))
        self.assertEqual(outcome.returncode, 0)
        self.assertIn("new: young", outcome.stdout)
        self.assertIn("gone: old", outcome.stdout)

    def test_bad_files_are_named(self):
        good = self.write("a", entry("track", 1))
        broken = self.folder / "broken"
        for text in ("", "{}", "[]", '{"benchmarks": []}', '{"benchmarks": 3, "context": {}}',
                     json.dumps({"context": {}, "benchmarks": [entry("track", 0)]}),
                     json.dumps({"context": {}, "benchmarks": [entry("track", "x")]}),
                     json.dumps({"context": {}, "benchmarks": [entry("track", 1, "years")]})):
            broken.write_text(text)
            outcome = self.compare(good, broken)
            self.assertEqual(outcome.returncode, 3, text)
            self.assertIn(str(broken), outcome.stderr)
            self.assertEqual(outcome.stdout, "")
        self.assertEqual(self.compare(good, self.folder / "missing").returncode, 3)

    def test_records_a_baseline(self):
        run = self.write("a", entry("track", 100), entry("track", 90), entry("reduce", 5))
        baseline = self.folder / "baseline"
        self.assertEqual(self.compare("--record", baseline, run).returncode, 0)
        self.assertEqual(len(json.loads(baseline.read_text())["benchmarks"]), 2)
        outcome = self.compare(baseline, run)
        self.assertEqual(outcome.returncode, 0)
        self.assertRegex(outcome.stdout, r"track +90 us +90 us +1\.00")
        self.assertEqual(self.compare("--record", self.folder / "no/where", run).returncode, 3)
        self.assertEqual(self.compare("--record", baseline, run, run).returncode, 2)

    def test_usage(self):
        self.assertEqual(self.compare().returncode, 2)
        self.assertEqual(self.compare("--threshold", "0.5", "a", "b").returncode, 2)
        self.assertEqual(self.compare("a", "b", "c").returncode, 2)

    def test_the_baseline_is_readable(self):
        baseline = ROOT / "bench/baseline.json"
        outcome = self.compare(baseline)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        self.assertIn("track/serial/grid", outcome.stdout)


if __name__ == "__main__":
    unittest.main()
