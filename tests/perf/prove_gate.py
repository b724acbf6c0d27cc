#!/usr/bin/env python3
"""Proves that the performance gate shuts for a slow-down and for nothing else: prove_gate.py RIVEN_PERF [CLASS]

A baseline of its own, made first, makes the proof independent of the processor that it runs on; the three scenes
without cracks, which take least, are enough for it. Then
  - a pass over the particles that nobody needs, hidden in one task, must shut the gate, by instructions and by time,
    and the gate must name the task;
  - runs beside as many busy programs as there are cores must leave it open: RIVEN_PROOF_RUNS of them, 2 if not said.
CLASS: Instructions, which may share the machine, or Times, which may not; both if not said.
"""
import os
import subprocess
import sys
import tempfile
import unittest

program = sys.argv.pop(1)
shut = 6
bad_input = 2
hidden_in = "particle to grid"


class Load:
    """As many programs as there are cores, each at work all the time: half of them with memory."""

    def __enter__(self):
        busy = ["a = 0\nwhile True: a += 1", "a = bytearray(1 << 26)\nwhile True: b = bytes(a)"]
        self.programs = [subprocess.Popen([sys.executable, "-c", busy[i % len(busy)]])
                         for i in range(len(os.sched_getaffinity(0)))]

    def __exit__(self, *error):
        for p in self.programs:
            p.kill()
            p.wait()


class Gate:
    """What both parts do; `only` leaves the other part out."""

    only = ""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        made = cls.gate("--update", "proof", timeout=600)
        if made.returncode != 0:
            raise RuntimeError(made.stdout + made.stderr)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def gate(cls, *options, first=3, **keywords):
        baseline = os.path.join(cls.folder.name, "baseline.json")
        command = [program, "gate", "--baseline", baseline, "--first", str(first), cls.only, *options]
        return subprocess.run(command, capture_output=True, text=True, **keywords)

    def test_a_second_pass_over_the_particles_shuts_it(self):
        run = self.gate("--slow-down", hidden_in, timeout=300)
        print(run.stdout)
        self.assertEqual(run.returncode, shut, run.stdout + run.stderr)
        lines = run.stdout.splitlines()
        lost = [n for n, line in enumerate(lines) if "LOST" in line]
        self.assertTrue(lost)
        for n in lost:
            self.assertTrue(lines[n + 1].startswith("  " + hidden_in), lines[n + 1])


class Instructions(Gate, unittest.TestCase):
    only = "--no-times"

    def test_update_leaves_a_line_of_history(self):
        with open(os.path.join(self.folder.name, "baseline.history.jsonl"), encoding="utf-8") as history:
            lines = history.readlines()
        self.assertEqual(len(lines), 1)
        self.assertIn('"reason":"proof"', lines[0])

    def test_a_part_of_the_scenes_does_not_become_the_baseline(self):
        run = self.gate("--update", "fewer", first=2, timeout=600)
        self.assertEqual(run.returncode, bad_input, run.stdout + run.stderr)
        self.assertIn("3 or more", run.stderr)

    def test_a_task_that_is_not_there_cannot_be_slowed_down(self):
        run = self.gate("--slow-down", "partcle to grid", timeout=60)
        self.assertEqual(run.returncode, bad_input)
        self.assertIn("particle to grid", run.stderr)


class Times(Gate, unittest.TestCase):
    only = "--no-instructions"

    def test_runs_on_a_loaded_machine_raise_no_alarm(self):
        with Load():
            for _ in range(int(os.environ.get("RIVEN_PROOF_RUNS", "2"))):
                run = self.gate(timeout=300)
                print(run.stdout)
                self.assertEqual(run.returncode, 0, run.stdout + run.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
