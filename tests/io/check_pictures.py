"""Read the results of a riven run with io/python and draw what can be drawn.

    python3 check_pictures.py RESULT_DIR

Needs h5py, numpy and matplotlib. Frames read by themselves and from the joined file must be equal, and each kind of
picture must come out as a PNG that shows something.
"""

import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "io" / "python"))

import numpy as np
from matplotlib.image import imread

import riven_picture
from riven_results import Results


class Joined(Results):
    """The same results without the folder of frames."""

    def _find(self, prefix):
        frames = super()._find(prefix)
        self.frames_found = len(frames)
        path = self.folder / f"{prefix}.vtkhdf"
        return [(path, step, time) for step, (_, _, time) in enumerate(frames)]


def require(condition, what):
    if not condition:
        sys.exit(f"check_pictures: {what}")


def check_frames(run, joined):
    for read in ("particles", "cracks"):
        for number in range(len(run)):
            one, other = getattr(run, read)(number), getattr(joined, read)(number)
            if one is None:
                continue
            require(set(one) == set(other), f"{read} {number}: other arrays")
            for name in one:
                require(np.array_equal(one[name], other[name], equal_nan=True), f"{read} {number}: other {name}")
            require(len(one.cells) == len(other.cells), f"{read} {number}: other cells")
            require(all(np.array_equal(a, b) for a, b in zip(one.cells, other.cells)), f"{read} {number}: other cells")


def main():
    folder = Path(sys.argv[1])
    run = Results(folder)
    require(len(run) > 0, "no frames")
    require(np.all(np.diff(run.times) >= 0), "times do not rise")
    check_frames(run, Joined(folder))
    columns = list(run.history)
    require(len(run.history[columns[0]]) > 0, "no rows in history.csv")
    with tempfile.TemporaryDirectory() as out:
        pictures = []
        names = ["von_mises", "sigma_yy", "velocity", "J", "body"]
        names += [n for n in ("fringe", "displacement_y") if n in riven_picture.fields(run.particles(0))]
        for name in names:
            pictures.append(Path(out) / f"{name}.png")
            riven_picture.main([str(folder), "--field", name, "-o", str(pictures[-1]), "--dpi", "60"])
        if "displacement" in run.particles(0):
            pictures.append(Path(out) / "magnified.png")
            riven_picture.main([str(folder), "--magnify", "10", "-o", str(pictures[-1]), "--dpi", "60"])
        pictures.append(Path(out) / "curve.png")
        riven_picture.main([str(folder), "--curve", *columns[:2], "-o", str(pictures[-1]), "--dpi", "60"])
        for path in pictures:
            image = imread(path)
            require(image.shape[0] > 60 and image.shape[1] > 60 and image[..., :3].std() > 0.01, f"{path.name} is empty")
    print(f"check_pictures: {len(run)} frames and {len(pictures)} pictures")


if __name__ == "__main__":
    main()
