#!/usr/bin/env python3
"""Proves that perf/plot.py draws what riven-perf prints, and reads it right: check_plot.py RIVEN_PERF PLOT_PY"""
import importlib.util
import math
import os
import subprocess
import sys
import tempfile
import unittest

plot_file = sys.argv.pop(2)
program = sys.argv.pop(1)
spec = importlib.util.spec_from_file_location("plot", plot_file)
plot = importlib.util.module_from_spec(spec)
spec.loader.exec_module(plot)


def benchmark(name, time, aggregate="", **counters):
    kind = {"run_type": "aggregate", "aggregate_name": aggregate} if aggregate else {"run_type": "iteration"}
    return {"run_name": name, "real_time": time, "repetitions": 2, **kind, **counters}


class Plot(unittest.TestCase):
    def draws(self, *options):
        with tempfile.TemporaryDirectory() as folder:
            printed = os.path.join(folder, "printed.json")
            with open(printed, "w", encoding="utf-8") as out:
                subprocess.run([program, *options, "--quick", "--json"], stdout=out, check=True)
            plot.main([printed])
            pixels = plot.plt.imread(os.path.join(folder, "printed.png"))
            self.assertGreater((pixels[..., :3].min(axis=-1) < 0.9).mean(), 0.05)  # no blank sheet

    def test_draws_throughput(self):
        self.draws("throughput", "--only", "block,sent", "--threads", "1")

    def test_draws_kernels(self):
        self.draws("kernels", "--no-counts", "--filter", "^block", "--repetitions", "2")

    def test_takes_the_median_of_each_task_once(self):
        data = {
            "benchmarks": [
                benchmark("a/move", 50),
                benchmark("a/move", 9, "median", flops=90, flops_per_byte=2),
                benchmark("a/move", 30, "mean"),
                benchmark("a/clear", 1, "median", flops=0, flops_per_byte=0),
                benchmark("a/whole step", 10, "median", flops=90),
            ],
            "context": {"fma_flops_per_second": "1e9", "threads": "1"},
        }
        (scene,), rates = plot.kernel_scenes(data)
        self.assertEqual(scene.tasks, {"move": 9, "clear": 1})
        self.assertEqual(scene.points, [("move", 2, 1e10), ("whole step", math.inf, 9e9)])
        self.assertEqual(rates, {"fma_flops_per_second": 1e9})

    def test_small_tasks_are_one_and_the_order_is_the_steps(self):
        one, two = plot.Scene("one"), plot.Scene("two")
        one.tasks = {"clear": 0.4, "move": 99, "last": 0.6}
        two.tasks = {"clear": 10, "contact": 10, "last": 10}
        self.assertEqual(one.shown(), {"move": 99, plot.OTHERS: 1})
        self.assertEqual(plot.in_order([one, two]), ["clear", "contact", "move", "last", plot.OTHERS])

    def test_refuses_what_is_not_of_riven_perf(self):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as other:
            other.write("{}")
            other.flush()
            with self.assertRaises(SystemExit) as refusal:
                plot.main([other.name])
            self.assertIn("neither", str(refusal.exception))


if __name__ == "__main__":
    unittest.main(verbosity=2)
