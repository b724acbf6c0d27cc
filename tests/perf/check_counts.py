#!/usr/bin/env python3
"""Proves that the flops in the bounds of riven-perf throughput are those that are counted: check_counts.py RIVEN_PERF

Counted is the block at the gate's small size, where the grid has more nodes for each particle: 1 % more flops.
"""
import json
import subprocess
import sys

limit = 0.03
program = sys.argv[1]


def printed(*options):
    run = subprocess.run([program, *options, "--quick", "--json"], stdout=subprocess.PIPE, check=True)
    return json.loads(run.stdout)


(counted,) = printed("kernels", "--filter", "^block/whole step$", "--repetitions", "1")["benchmarks"]
assumed = printed("throughput", "--only", "block", "--threads", "1")["flops_per_particle_step"]
print(f"{counted['flops']:.1f} flops per particle-step are counted, {assumed} assumed; {counted['instructions']:.0f}"
      f" instructions, {counted['roofline_share']:.2f} of the roofline")
if not counted["roofline_share"] > 0 or abs(counted["flops"] / assumed - 1) > limit:
    sys.exit("flops_per_particle_step in perf/throughput.hpp is out of date: riven-perf kernels --filter '^large block/'")
