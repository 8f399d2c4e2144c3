# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: The SLAMBench authors
"""Compares the figures of `slambench evaluate` and `slambench run` with evo:
check_with_evo.py SLAMBENCH

On trajectories made here, and, where SLAMBENCH_DATA names the folder of the public ones, on those
and on short runs.
"""

import copy
import json
import os
import subprocess
import sys
import tempfile

import numpy as np
from evo.core import metrics, sync
from evo.tools import file_interface

TOLERANCE_M = 1e-6
TOLERANCE_DEG = 1e-4
FIGURES = ("rmse", "mean", "median", "std", "min", "max")


def write_example(folder):
    """A noisy, drifting, scaled and moved estimate at 30 Hz of a path known at 100 Hz."""
    rng = np.random.default_rng(1)

    def write(name, times, jitter, scale, shift):
        lines = ["# time tx ty tz qx qy qz qw"]
        for t in times:
            p = scale * np.array([np.sin(t), 0.5 * np.cos(2 * t), 0.3 * t]) + shift
            p += rng.normal(0, jitter, 3) + jitter * np.array([t, 0, 0])
            q = np.array([0.2 * np.sin(3 * t), 0.1 * t, 0.3, 1]) + rng.normal(0, jitter, 4)
            q /= np.linalg.norm(q)
            lines.append(" ".join(f"{v:.9f}" for v in (t, *p, *q)))
        path = os.path.join(folder, name)
        with open(path, "w", encoding="ascii") as file:
            file.write("\n".join(lines) + "\n")
        return path

    truth = write("truth.txt", np.arange(0, 12, 0.01), 0.0, 1.0, np.zeros(3))
    dense = np.arange(-0.5, 12.5, 1 / 30) + rng.uniform(-0.008, 0.008, 390)
    estimate = write("estimate.txt", dense, 0.01, 1.1, np.array([3.0, -2.0, 1.0]))
    sparse = write("sparse_truth.txt", np.arange(0, 12, 0.25), 0.0, 1.0, np.zeros(3))
    return [(estimate, truth), (estimate, sparse)]


def public_examples():
    folder = os.environ.get("SLAMBENCH_DATA")
    if not folder:
        print("SLAMBENCH_DATA is not set: only on trajectories made here")
        return []
    names = [
        ("fr2_desk_ORB.txt", "fr2_desk_groundtruth.txt"),
        ("freiburg1_xyz-rgbdslam.txt", "freiburg1_xyz-groundtruth.txt"),
        ("livingRoom0.gt.freiburg", "livingRoom1.gt.freiburg"),
    ]
    return [tuple(os.path.join(folder, "trajectories", n) for n in pair) for pair in names]


def ours(program, estimate, truth, *options):
    command = [program, "evaluate", estimate, truth, "--association", "evo", "--json", *options]
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)


def evo_ape(truth, estimate, alignment):
    estimate = copy.deepcopy(estimate)
    if alignment == "first-pose":
        estimate.align_origin(truth)
    elif alignment != "none":
        estimate.align(truth, correct_scale=alignment == "sim3")
    metric = metrics.APE(metrics.PoseRelation.translation_part)
    metric.process_data((truth, estimate))
    return metric.get_all_statistics()


def evo_rpe(truth, estimate, relation, delta, unit):
    metric = metrics.RPE(relation, delta=delta, delta_unit=unit, rel_delta_tol=0.1, all_pairs=True)
    metric.process_data((truth, estimate))
    return len(metric.error), metric.get_all_statistics()


class Comparison:
    def __init__(self):
        self.count = 0
        self.worst = 0.0
        self.failures = []

    def same(self, what, found, expected, tolerance):
        self.count += 1
        self.worst = max(self.worst, abs(found - expected) / tolerance)
        if not abs(found - expected) <= tolerance:
            self.failures.append(f"{what}: found {found!r}, evo has {expected!r}")


def compare(program, estimate_file, truth_file, comparison):
    truth = file_interface.read_tum_trajectory_file(truth_file)
    estimate = file_interface.read_tum_trajectory_file(estimate_file)
    truth, estimate = sync.associate_trajectories(truth, estimate, max_diff=0.01)
    label = os.path.basename(estimate_file)

    result = ours(program, estimate_file, truth_file, "--alignment", "all")
    comparison.same(f"{label}: pairs", result["matched"], truth.num_poses, 0.5)
    for alignment in ("none", "first-pose", "se3", "sim3"):
        expected = evo_ape(truth, estimate, alignment)
        for figure in FIGURES:
            comparison.same(f"{label}: ATE {alignment} {figure}",
                            result["ate_m"][alignment][figure], expected[figure], TOLERANCE_M)

    for word, unit, delta in (("frames", metrics.Unit.frames, 1), ("frames", metrics.Unit.frames, 7),
                              ("meters", metrics.Unit.meters, 0.5)):
        result = ours(program, estimate_file, truth_file, "--rpe-delta", str(delta), "--rpe-unit", word)
        for key, relation, tolerance in (
            ("translation_m", metrics.PoseRelation.translation_part, TOLERANCE_M),
            ("rotation_deg", metrics.PoseRelation.rotation_angle_deg, TOLERANCE_DEG),
        ):
            pairs, expected = evo_rpe(truth, estimate, relation, delta, unit)
            what = f"{label}: RPE {delta} {word} {key}"
            comparison.same(f"{what} pairs", result["rpe"][key]["count"], pairs, 0.5)
            for figure in FIGURES:
                comparison.same(f"{what} {figure}", result["rpe"][key][figure], expected[figure],
                                tolerance)


# Small images and volumes: what is compared is the judging.
RUNS = [
    ("icl_nuim_lr_kt3_400", "--frames", "40", "-c", "4", "-v", "96"),
    ("tum_fr1_xyz_300", "--frames", "40", "-c", "4", "-v", "96"),
]


def compare_run(program, folder, run, comparison):
    """The figures in a run's record with those of the trajectory it wrote."""
    sequence = os.path.join(os.environ["SLAMBENCH_DATA"], run[0])
    out = os.path.join(folder, run[0])
    subprocess.run([program, "run", sequence, *run[1:], "--quiet", "--out", out], check=True)
    with open(os.path.join(out, "record.json"), encoding="utf-8") as file:
        record = json.load(file)
    accuracy = record["accuracy"]["over_processed"]
    truth = file_interface.read_tum_trajectory_file(record["sequence"]["ground_truth_file"])
    estimate = file_interface.read_tum_trajectory_file(os.path.join(out, "trajectory.tum"))
    truth, estimate = sync.associate_trajectories(truth, estimate, max_diff=0.01)
    comparison.same(f"{run[0]}: pairs", accuracy["matched"], truth.num_poses, 0.5)
    for alignment in ("none", "first-pose", "se3", "sim3"):
        expected = evo_ape(truth, estimate, alignment)
        found = accuracy["ate_m"][alignment.replace("-", "_")]
        for figure in FIGURES:
            comparison.same(f"{run[0]}: ATE {alignment} {figure}", found[figure],
                            expected[figure], TOLERANCE_M)


def main():
    program = sys.argv[1]
    comparison = Comparison()
    with tempfile.TemporaryDirectory() as folder:
        for estimate, truth in write_example(folder) + public_examples():
            compare(program, estimate, truth, comparison)
        for run in RUNS if "SLAMBENCH_DATA" in os.environ else []:
            compare_run(program, folder, run, comparison)
    for failure in comparison.failures:
        print(failure)
    print(f"{comparison.count} figures compared, {len(comparison.failures)} differ; the largest "
          f"difference is {comparison.worst:.2g} of what is allowed")
    return 1 if comparison.failures else 0


if __name__ == "__main__":
    sys.exit(main())
