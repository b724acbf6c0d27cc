"""Draw studies whose errors and times span from a hundredth of a decade to many, and read the labels of the axes.

    python3 check_study_picture.py

Needs numpy and matplotlib. Each axis must have at least three labels, of plain numbers, none on top of another.
"""

import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "io" / "python"))

import riven_study


def require(condition, what):
    if not condition:
        sys.exit(f"check_study_picture: {what}")


def study_of(errors, costs):
    """What study.json has of a study of one axis, refined."""
    numbers = range(len(errors))
    points = [{"cost": c, "error": e, "settled_error": e} for c, e in zip(costs, errors)]
    result = {"name": "J", "limits": [], "settings": points, "fits": [{"order": 1}], "front": list(numbers)}
    return {
        "title": "study",
        "timed": True,
        "axes": [{"name": "cell", "refined": True, "problem": False}],
        "members": [{"label": f"cell {k}", "choice": [k], "status": "done"} for k in numbers],
        "settings": [{"members": [k]} for k in numbers],
        "methods": [{"label": "as it is", "settings": list(numbers)}],
        "results": [result],
    }


def check_axis(axis, renderer, what):
    low, high = axis.get_view_interval()
    ticks = [(at, label) for which in (False, True) for at, label in labels_of(axis, which) if low <= at <= high]
    require(len(ticks) >= 3, f"{what}: {len(ticks)} labels")
    for at, label in ticks:
        require(abs(float(label.get_text()) / at - 1) < 1e-5, f"{what}: '{label.get_text()}' at {at:g}")
    boxes = [label.get_window_extent(renderer) for _, label in ticks]
    for k, box in enumerate(boxes):
        require(not any(box.overlaps(other) for other in boxes[:k]), f"{what}: labels overlap at {ticks[k][0]:g}")


def labels_of(axis, minor):
    return [
        (at, label)
        for at, label in zip(axis.get_ticklocs(minor=minor), axis.get_ticklabels(minor=minor))
        if label.get_text()
    ]


def main():
    figures = []
    riven_study.plt.close = figures.append
    spans = [1.003, 1.1, 2, 3, 9, 11, 50, 900, 2e4, 1e6, 1e9]
    with tempfile.TemporaryDirectory() as out:
        for span in spans:
            study = study_of([0.07, 0.07 / span**0.5, 0.07 / span], [0.031, 0.031 * span**0.5, 0.031 * span])
            riven_study.draw_result(study, study["results"][0], Path(out) / "J.png", 60)
            (axes,) = figures[-1].axes
            for name, axis in (("time", axes.xaxis), ("error", axes.yaxis)):
                try:
                    check_axis(axis, figures[-1].canvas.get_renderer(), f"{name} over {span:g}")
                except ValueError as unread:
                    sys.exit(f"check_study_picture: {name} over {span:g}: {unread}")
    print(f"check_study_picture: {len(spans)} pictures")


if __name__ == "__main__":
    main()
