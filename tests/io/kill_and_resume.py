"""Kills a run at random moments and takes it up again, until it has come to its end: what was finished always opens, and
the end is to the last bit that of a run that nobody disturbed.

    kill_and_resume.py RIVEN FOLDER [--kills 200] [--seed 1]

The run: cracks that grow, in contact, with frames, rows and checkpoints so often that kills meet all of them. When it
ends before there were enough kills, it begins anew. Prints what was done; fails at the first difference.
"""

import argparse
import json
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py

SETTINGS = [
    "grid.cell=0.79375 mm", "growth.toughness=0.05 MPa m^0.5", "solver.time=60 us", "solver.deterministic=true",
    "output.frames=12", "output.history_every=0.5 us", "output.checkpoint_steps=4",
]
# The wall time of what is done between steps, as the rate, is that since the run was taken up again.
TIMES = {"wall_seconds", "between_steps", "particle_steps_per_second", "peak_memory_bytes", "threads"}


def command(riven, folder, threads, resume):
    start = ["--restart", str(folder)] if resume else ["ten_cracks_fast", "-o", str(folder)]
    if not resume:
        for setting in SETTINGS:
            start += ["--set", setting]
    return [riven, "run", *start, "--threads", str(threads), "--quiet"]


def expect(condition, what):
    if not condition:
        sys.exit(f"kill_and_resume: {what}")


def check_last_frame(folder):
    """The newest frame opens and is complete."""
    frames = sorted((folder / "frames").glob("particles_*.vtkhdf")) if folder.exists() else []
    if frames:
        with h5py.File(frames[-1]) as f:
            points = f["VTKHDF/Points"]
            expect(len(points) == len(f["VTKHDF/PointData/stress"]) > 0, f"{frames[-1]} lacks points")


def check_history(folder):
    """Rows are in the order of time, none twice, and all but one cut off by the kill are whole."""
    path = folder / "history.csv"
    rows = path.read_text().splitlines()[1:-1] if path.exists() else []
    times = [float(row.split(",")[0]) for row in rows]
    expect(all(a < b for a, b in zip(times, times[1:])), f"{path}: rows out of order")


def results(folder):
    """All that a finished run has left, by file; of the summary what is no time."""
    left = {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}
    summary = json.loads(left.pop("summary.json"))
    for key in TIMES:
        summary.pop(key)
    for task in summary["tasks"]:
        task.pop("seconds")
    for name in ("checkpoint.h5", "checkpoint.previous.h5"):
        left.pop(name, None)  # their task times differ
    return left, summary


def compare(folder, reference):
    (a, summary_a), (b, summary_b) = results(folder), results(reference)
    expect(a.keys() == b.keys(), f"other files: {sorted(a.keys() ^ b.keys())}")
    for name, content in b.items():
        expect(a[name] == content, f"{name} is not that of the undisturbed run")
    for key, value in summary_b.items():
        expect(summary_a[key] == value, f"summary.json: {key}: {summary_a[key]} instead of {value}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("riven")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    shutil.rmtree(options.folder, ignore_errors=True)
    reference, folder = options.folder / "undisturbed", options.folder / "killed"

    began = time.monotonic()
    subprocess.run(command(options.riven, reference, 1, resume=False), check=True)
    longest = max(0.1, 0.35 * (time.monotonic() - began))

    kills = runs = moved = 0
    while kills < options.kills or runs == 0:
        resume = any((folder / name).exists() for name in ("checkpoint.h5", "checkpoint.previous.h5"))
        moved += resume
        process = subprocess.Popen(command(options.riven, folder, chance.choice([1, 2]), resume), stderr=subprocess.PIPE)
        try:
            _, errors = process.communicate(timeout=chance.uniform(0, longest) if kills < options.kills else None)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            _, errors = process.communicate()
            kills += process.returncode == -signal.SIGKILL
        expect(process.returncode in (0, -signal.SIGKILL), f"exit code {process.returncode}: {errors.decode()}")
        expect(not errors, errors.decode())
        check_last_frame(folder)
        check_history(folder)
        if process.returncode == 0:
            compare(folder, reference)
            runs += 1
            shutil.rmtree(folder)
    print(f"{kills} kills, {moved} restarts, {runs} runs that came to their end, all as the undisturbed one")


if __name__ == "__main__":
    main()
