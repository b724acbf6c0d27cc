"""Draw what `riven study` found: error against time for every method, with the choices that nothing beats marked.

    python3 riven_study.py results/sent_j

One picture for each result of the study, RESULT.png, from study.json in the folder. Curves join the settings of a method
along the refined axis; where there are many, they share colours by the first of the other axes. Where the study has
several problems, the error is the largest of them, and RESULT_problems.png shows each. What failed is listed below the
picture, and shown in another one, RESULT_map.png, by method and place on the refined axis.
"""

import argparse
import json
import re
import sys
from pathlib import Path

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.colors
    import matplotlib.pyplot as plt
    import matplotlib.ticker
    import numpy as np
except ModuleNotFoundError as missing:
    sys.exit(f"{missing}: pictures need NumPy and Matplotlib for this Python; Debian's are with /usr/bin/python3")

MARKERS = "osD^v<>pPX*hd"
LINES = ["-", "--", ":", "-."]


def nan(x):
    return float("nan") if x is None else x


def axis_of(study, kind):
    """The number of the axis that is "refined", or the "problem"; none where there is none."""
    return next((n for n, axis in enumerate(study["axes"]) if axis[kind]), None)


def choice_of(study, setting):
    """The choices that its members share; that of the problem is the first one's."""
    return study["members"][study["settings"][setting]["members"][0]]["choice"]


def styles(study):
    """A colour, a marker and a line for each method, by the choices of the first three axes that tell methods apart."""
    axes = [n for n, axis in enumerate(study["axes"]) if not axis["refined"] and not axis["problem"]]
    palette = plt.get_cmap("tab10").colors
    of = {}
    for number, method in enumerate(study["methods"]):
        choice = choice_of(study, method["settings"][0])
        place = [choice[a] for a in axes[:3]] if axes else [number]
        place += [0] * (3 - len(place))
        of[number] = {
            "color": palette[place[0] % len(palette)],
            "marker": MARKERS[place[1] % len(MARKERS)],
            "linestyle": LINES[place[2] % len(LINES)],
        }
    return of


def label_ticks(axis):
    """Plain numbers on a log axis: 1, 2, 5 of each decade, all whole ones within less than a decade, what lies between
    where that still leaves few, and powers of ten where there are many."""
    low, high = axis.get_view_interval()
    decades = np.log10(high / low)
    if decades < 0.4:
        ticks = matplotlib.ticker.MaxNLocator(nbins=6, steps=[1, 2, 2.5, 5, 10])
    elif decades < 1:
        ticks = matplotlib.ticker.LogLocator(subs=range(1, 10))
    elif decades < 4:
        ticks = matplotlib.ticker.LogLocator(subs=(1, 2, 5))
    else:
        ticks = matplotlib.ticker.LogLocator(numticks=9)
    axis.set_major_locator(ticks)
    axis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    axis.set_minor_formatter(matplotlib.ticker.NullFormatter())


def draw_result(study, result, out, dpi):
    name = result["name"]
    costs = [nan(s["cost"]) for s in result["settings"]]
    errors = [nan(s["error"]) for s in result["settings"]]
    figure, axes = plt.subplots(figsize=(9, 6), layout="constrained")
    refined = axis_of(study, "refined") is not None
    for number, (method, style) in enumerate(zip(study["methods"], styles(study).values())):
        good = [k for k in method["settings"] if np.isfinite(errors[k])]
        label = method["label"]
        order = nan(result["fits"][number]["order"])
        if np.isfinite(order):
            label += f"  (order {order:.1f})"
        axes.plot(
            [costs[k] for k in good],
            [100 * errors[k] for k in good],
            markersize=5,
            linewidth=1,
            alpha=0.85,
            label=label,
            **{**style, "linestyle": style["linestyle"] if refined else "none"},
        )
    front = result["front"]
    axes.plot(
        [costs[k] for k in front],
        [100 * result["settings"][k]["settled_error"] for k in front],
        color="black",
        linewidth=3,
        alpha=0.25,
        marker="o",
        markersize=12,
        markerfacecolor="none",
        drawstyle="steps-post",
        label="what is to be had for the time" + (",\nwhen finer, too" if refined else ""),
    )
    spreads = [limit["spread"] / abs(limit["value"]) for limit in result["limits"] if limit and limit["value"]]
    if spreads:
        axes.axhspan(1e-6, 100 * max(spreads), color="grey", alpha=0.15, linewidth=0)
    shown = [100 * e for e in errors if np.isfinite(e) and e > 0]
    if shown:
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_ylim(max(min(shown) / 2, 1e-4), max(shown) * 2)
        for axis in (axes.xaxis, axes.yaxis):
            label_ticks(axis)
    else:
        axes.text(0.5, 0.5, "no error can be told", ha="center", transform=axes.transAxes)
    problem = axis_of(study, "problem")
    several = problem is not None
    all_of_them = f"{len(study['axes'][problem]['choices'])} problems" if several else ""
    time = "wall time of " + (f"the runs of {all_of_them}" if several else "a run")
    axes.set_xlabel(time + (" [s]" if study["timed"] else " beside others [s]"))
    axes.set_ylabel((f"largest error of {name} in {all_of_them}" if several else f"error of {name}") + " [%]")
    axes.grid(which="both", alpha=0.2)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, fontsize=7, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    axes.set_title(study["title"], fontsize=10)
    failed = [f"{m['label']}: {m['status']}" for m in study["members"] if m["status"] != "done"]
    if failed:
        more = f" and {len(failed) - 6} more" if len(failed) > 6 else ""
        figure.supxlabel("; ".join(failed[:6]) + more, fontsize=6, color="tab:red")
    figure.savefig(out, dpi=dpi)
    plt.close(figure)


def draw_table(study, name, errors, rows, axis, out, dpi):
    """Errors [rows, choices of the axis] in colour, in per cent; a cross where a run did not end."""
    columns = [choice["label"] for choice in axis["choices"]]
    figure, axes = plt.subplots(
        figsize=(4 + 0.2 * len(columns) + 0.05 * sum(map(len, columns)), 1.5 + 0.17 * len(rows)), layout="constrained"
    )
    image = axes.imshow(
        errors, aspect="auto", cmap="viridis", norm=matplotlib.colors.LogNorm(vmin=0.01, vmax=10, clip=True)
    )
    for row, column in np.argwhere(~np.isfinite(errors)):
        axes.text(column, row, "\u00d7", ha="center", va="center", color="tab:red", fontsize=9)
    if len(columns) <= 10:
        for row, column in np.argwhere(np.isfinite(errors)):
            dark = errors[row, column] < 0.5
            text = f"{errors[row, column]:.2g}"
            axes.text(column, row, text, ha="center", va="center", color="white" if dark else "black", fontsize=6)
    axes.set_xticks(range(len(columns)), columns)
    axes.set_yticks(range(len(rows)), rows, fontsize=6)
    axes.set_xlabel(axis["name"])
    figure.colorbar(image, label=f"error of {name} [%]; red: stopped", shrink=0.6)
    axes.set_title(study["title"], fontsize=10)
    figure.savefig(out, dpi=dpi)
    plt.close(figure)


def draw_map(study, result, out, dpi):
    """Methods against the refined axis, by size."""
    refined = axis_of(study, "refined")
    axis = study["axes"][refined]
    methods = study["methods"]
    errors = np.full((len(methods), len(axis["choices"])), np.nan)
    for row, method in enumerate(methods):
        for k in method["settings"]:
            errors[row, choice_of(study, k)[refined]] = 100 * nan(result["settings"][k]["error"])
    order = np.argsort([choice["size"] for choice in axis["choices"]])
    by_size = {**axis, "choices": [axis["choices"][k] for k in order]}
    draw_table(study, result["name"], errors[:, order], [m["label"] for m in methods], by_size, out, dpi)


def draw_problems(study, result, out, dpi):
    """Settings against problems."""
    name = result["name"]
    errors = np.array(
        [[100 * nan(study["members"][m]["results"][name]["error"]) for m in s["members"]] for s in study["settings"]]
    )
    rows = [s["label"] for s in study["settings"]]
    draw_table(study, name, errors, rows, study["axes"][axis_of(study, "problem")], out, dpi)


def draw_left_out(study, out, dpi):
    """What leaving each effect out saves, and what it does to the answer."""
    effects = study["left_out"]
    names = list(effects[0]["changes"])
    figure, axes = plt.subplots(
        1, 1 + len(names), figsize=(4 + 3 * len(names), 1.2 + 0.4 * len(effects)), sharey=True, layout="constrained"
    )
    places = np.arange(len(effects))
    columns = [("of the run's time saved [%]", [100 * nan(e["cost"]) for e in effects])]
    columns += [(f"change of {name} [%]", [100 * nan(e["changes"][name]) for e in effects]) for name in names]
    for axis, (label, values) in zip(axes, columns):
        axis.barh(places, values, height=0.6)
        axis.set_xlabel(label)
        axis.axvline(0, color="black", linewidth=0.8)
        axis.spines[["top", "right"]].set_visible(False)
    axes[0].set_yticks(places, ["without " + e["name"] for e in effects])
    axes[0].invert_yaxis()
    figure.suptitle(study["title"], fontsize=10)
    figure.savefig(out, dpi=dpi)
    plt.close(figure)


def file_name(text):
    return re.sub(r"[^\w.-]+", "_", text) + ".png"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="results of `riven study`")
    parser.add_argument("--dpi", type=int, default=120)
    arguments = parser.parse_args()
    path = arguments.folder / "study.json"
    if not path.is_file():
        sys.exit(f"{path}: no such file; run `riven study` first")
    study = json.loads(path.read_text(encoding="utf-8"))
    if study["methods"]:
        for result in study["results"]:
            draw_result(study, result, arguments.folder / file_name(result["name"]), arguments.dpi)
            if axis_of(study, "problem") is not None:
                draw_problems(study, result, arguments.folder / file_name(result["name"] + " problems"), arguments.dpi)
            if axis_of(study, "refined") is not None and any(m["status"] != "done" for m in study["members"]):
                draw_map(study, result, arguments.folder / file_name(result["name"] + " map"), arguments.dpi)
    if study["left_out"]:
        draw_left_out(study, arguments.folder / "left_out.png", arguments.dpi)


if __name__ == "__main__":
    main()
