"""Draw what riven-perf measured: nanoseconds per particle of each task, stacked, and the roofline of the machine.

    riven-perf throughput --json > throughput.json && python3 plot.py throughput.json
    riven-perf kernels --json > kernels.json       && python3 plot.py kernels.json -o kernels.png

The roofline is that of the machine when it was measured; below it stand the steps of the block, or the tasks of each
scene, at their flops per byte of memory traffic, and at the right edge what has next to none. Tasks that take less than
1 % of a step are one in its bar, and no point; nor are those without arithmetic.
"""

import argparse
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

SMALL = 0.01  # of a step: tasks that take less are drawn as one
OTHERS = "others"
FEW = 1  # flops per particle: tasks with less do no arithmetic to speak of


class Scene:
    """A bar: the times of the tasks, ns per particle and step, and the points of the roofline."""

    def __init__(self, name):
        self.name = name
        self.tasks = {}  # label: ns
        self.points = []  # label, flops per byte (infinite where nothing leaves the cache), flop/s

    def shown(self):
        total = sum(self.tasks.values())
        large = {label: t for label, t in self.tasks.items() if t >= SMALL * total}
        rest = total - sum(large.values())
        return {**large, OTHERS: rest} if rest > 0 else large


def throughput_scenes(data, threads):
    """Scenes of `riven-perf throughput --json`, and the machine's rates at that number of threads."""
    rates = {r["threads"]: r for r in data["rates"]}
    if threads not in rates:
        raise ValueError(f"no run on {threads} threads; there are: {', '.join(map(str, rates))}")
    flops, size = data["flops_per_particle_step"], data["bytes_per_particle_step"]
    scenes = []
    for group in data["groups"]:
        for run in group["runs"]:
            if run["threads"] != threads:
                continue
            scene = Scene(run["name"] if run["name"] == group["name"] else f"{group['name']}: {run['name']}")
            scene.tasks = {t["label"]: t["nanoseconds_per_particle_step"] for t in run["tasks"]}
            if group["name"] in ("block", "large"):  # the counts are this step's
                intensity = flops / size if run["memory_share"] > 0 else np.inf
                scene.points = [("whole step", intensity, flops * run["particle_steps_per_second"]["best"])]
            scenes.append(scene)
    return scenes, rates[threads]


def kernel_scenes(data):
    """Scenes of `riven-perf kernels --json`, and the machine's rates."""
    scenes = {}
    for run in data["benchmarks"]:
        if run["run_type"] == "aggregate" and run["aggregate_name"] != "median" or (
            run["run_type"] == "iteration" and run["repetitions"] > 1
        ):
            continue
        name, label = run["run_name"].split("/", 1)
        scene = scenes.setdefault(name, Scene(name))
        if label != "whole step":
            scene.tasks[label] = run["real_time"]
        if run.get("flops", 0) > FEW and run["real_time"] > 0:
            scene.points.append((label, run.get("flops_per_byte", np.inf), 1e9 * run["flops"] / run["real_time"]))
    for scene in scenes.values():
        scene.points = [p for p in scene.points if p[0] == "whole step" or p[0] in scene.shown()]
    return list(scenes.values()), {k: float(v) for k, v in data["context"].items() if k.endswith("_per_second")}


def in_order(scenes):
    """Labels of all scenes, each behind the one that it follows where it first appears; the others last."""
    labels = []
    for scene in scenes:
        place = 0
        for label in scene.tasks:
            if label not in labels:
                labels.insert(place, label)
            place = labels.index(label) + 1
    return [*labels, OTHERS]


def draw_bars(axes, scenes):
    shown = [scene.shown() for scene in scenes]
    labels = [label for label in in_order(scenes) if any(label in tasks for tasks in shown)]
    palette = [*plt.get_cmap("tab20").colors, *plt.get_cmap("tab20b").colors]
    below = np.zeros(len(scenes))
    places = np.arange(len(scenes))
    for n, label in enumerate(labels):
        times = np.array([tasks.get(label, 0) for tasks in shown])
        colour = "lightgrey" if label == OTHERS else palette[n % len(palette)]
        axes.barh(places, times, left=below, color=colour, label=label, height=0.7)
        below += times
    for place, total in zip(places, below):
        axes.text(total, place, f" {total:.1f}", va="center", fontsize=8)
    axes.set_yticks(places, [scene.name for scene in scenes], fontsize=8)
    axes.invert_yaxis()
    axes.set_xlim(0, 1.1 * below.max())
    axes.set_xlabel("time per particle and step [ns]")
    axes.legend(frameon=False, fontsize=7, ncol=1, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    axes.spines[["top", "right"]].set_visible(False)


def draw_roofline(axes, scenes, rates):
    fma, triad = rates["fma_flops_per_second"] / 1e9, rates["triad_bytes_per_second"] / 1e9
    ridge = fma / triad
    finite = [x for scene in scenes for _, x, _ in scene.points if 0 < x < 1000 * ridge]
    left, right = min([0.1 * ridge, *finite]) / 2, max([10 * ridge, *finite]) * 4
    axes.plot([left, ridge, right], [triad * left, fma, fma], color="black", linewidth=1.4)
    axes.annotate(f"triad {triad:.1f} GB/s", (ridge / 3, fma / 3), ha="right", va="bottom", fontsize=8)
    axes.annotate(f"multiply-adds {fma:.1f} Gflop/s", (ridge, fma * 1.15), fontsize=8)
    markers = "osD^v<>pPX*hd"
    for n, scene in enumerate(scenes):
        if not scene.points:
            continue
        x = [right / 1.3 if i >= 1000 * ridge else i for _, i, _ in scene.points]
        y = [rate / 1e9 for _, _, rate in scene.points]
        axes.scatter(x, y, s=22, alpha=0.8, marker=markers[n % len(markers)], label=scene.name)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(left, right)
    axes.set_ylim(top=3 * fma)
    axes.set_xlabel("arithmetic intensity [flop/byte beyond the caches; right edge: all in cache]")
    axes.set_ylabel("rate [Gflop/s]")
    axes.legend(frameon=False, fontsize=7, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    axes.grid(alpha=0.3)
    axes.spines[["top", "right"]].set_visible(False)


def draw(scenes, rates, title, out, dpi):
    if not any(scene.tasks for scene in scenes):
        raise ValueError("no task in it")
    figure, (bars, roof) = plt.subplots(
        2, 1, figsize=(9, 5.5 + 0.35 * len(scenes)), height_ratios=[0.6 + 0.35 * len(scenes), 4.5], layout="constrained"
    )
    draw_bars(bars, scenes)
    draw_roofline(roof, scenes, rates)
    figure.suptitle(title, fontsize=10)
    figure.savefig(out, dpi=dpi)
    plt.close(figure)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", metavar="FILE", help="the output of riven-perf throughput or kernels with --json")
    parser.add_argument("--threads", type=int, help="which runs of throughput to draw (default: the fewest threads)")
    parser.add_argument("-o", "--out", help="the picture (default: FILE with .png)")
    parser.add_argument("--dpi", type=int, default=150)
    options = parser.parse_args(arguments)
    try:
        data = json.loads(Path(options.file).read_text(encoding="utf-8"))
        if "groups" in data:
            threads = options.threads or min(r["threads"] for r in data["rates"])
            scenes, rates = throughput_scenes(data, threads)
            machine = data["machine"]
        elif "benchmarks" in data:
            scenes, rates = kernel_scenes(data)
            threads, machine = data["context"]["threads"], data["context"]["machine"]
        else:
            raise ValueError(f"{options.file} is neither of riven-perf throughput nor of riven-perf kernels")
        out = options.out or Path(options.file).with_suffix(".png")
        draw(scenes, rates, f"{machine}; threads used: {threads}", out, options.dpi)
        print(out)
    except (OSError, KeyError, TypeError, ValueError) as error:
        sys.exit(f"plot: {error}")


if __name__ == "__main__":
    main()
