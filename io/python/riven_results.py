"""Read the results of a riven run: frames, history and summary as numpy arrays.

    from riven_results import Results
    run = Results("results/ten_cracks")
    run.times                        # s, of the frames
    frame = run.particles(-1)        # the last frame
    frame["stress"][:, 1]            # sigma_yy, Pa
    run.history["time"], run.units["time"]
    run.summary["energy"]["relative_error"]

Frames are taken from the folder `frames`, so that a run that goes on, or was killed, can be read as far as
it has come; without that folder from particles.vtkhdf and cracks.vtkhdf. Everything is in SI.
"""

import csv
import json
import re
from pathlib import Path

import h5py
import numpy as np


class Frame(dict):
    """Arrays by name: "points" (n, 3), every point array, and cell arrays as "cell:<name>"; floats in double.

    `time` in s; `units` by array name; `cells`, a list of arrays of point numbers, one for each line
    (empty where the cells are vertices).
    """

    def __init__(self, time):
        super().__init__()
        self.time = time
        self.units = {}
        self.cells = []


class Results:
    def __init__(self, folder):
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise FileNotFoundError(f"{folder}: no such folder of results")
        self._steps = {prefix: self._find(prefix) for prefix in ("particles", "cracks")}
        self._history = None

    def __len__(self):
        """How many frames of particles there are."""
        return len(self._steps["particles"])

    @property
    def times(self):
        """Time of each frame, s."""
        return np.array([time for _, _, time in self._steps["particles"]])

    def particles(self, frame=-1):
        return self._read("particles", frame)

    def cracks(self, frame=-1):
        """The cracks of a frame, or None where the scene has none."""
        return self._read("cracks", frame) if self._steps["cracks"] else None

    @property
    def history(self):
        """Columns of history.csv by name; where names repeat, the last, and each as "name [unit]"."""
        return self._load_history()[0]

    @property
    def units(self):
        """Units of the columns of history.csv by name; "1" for a pure number."""
        return self._load_history()[1]

    @property
    def summary(self):
        """summary.json, or an empty dictionary before the run has ended."""
        path = self.folder / "summary.json"
        return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}

    def _find(self, prefix):
        """(file, step in the file, time) of every frame."""
        numbered = [
            (int(match.group(1)), path)
            for path in (self.folder / "frames").glob(f"{prefix}_*.vtkhdf")
            if (match := re.fullmatch(prefix + r"_(\d+)", path.stem))
        ]
        paths = [path for _, path in sorted(numbered)] or [
            path for path in [self.folder / f"{prefix}.vtkhdf"] if path.is_file()
        ]
        found = []
        for path in paths:
            with h5py.File(path, "r") as file:
                times = file["VTKHDF/Steps/Values"][:]
            found += [(path, step, float(time)) for step, time in enumerate(times)]
        return found

    def _read(self, prefix, frame):
        path, step, time = self._steps[prefix][frame]
        out = Frame(time)
        with h5py.File(path, "r") as file:
            root = file["VTKHDF"]
            steps = root["Steps"]
            part = int(steps["PartOffsets"][step])

            def rows(dataset, first, count):
                values = dataset[int(first) : int(first) + int(count)]
                return values.astype(float) if values.dtype == np.float32 else values

            points = root["NumberOfPoints"][part]
            out["points"] = rows(root["Points"], steps["PointOffsets"][step], points)
            for name, dataset in root["PointData"].items():
                out[name] = rows(dataset, steps["PointDataOffsets"][name][step], points)
                out.units[name] = dataset.attrs.get("unit", b"").decode()
            cells = sum(int(root[kind]["NumberOfCells"][part]) for kind in ("Vertices", "Lines"))
            for name, dataset in root["CellData"].items():
                out["cell:" + name] = rows(dataset, steps["CellDataOffsets"][name][step], cells)
            lines = root["Lines"]
            # each part has one more offset than cells
            first = steps["CellOffsets"][step][1] + part
            offsets = rows(lines["Offsets"], first, lines["NumberOfCells"][part] + 1)
            ids = rows(
                lines["Connectivity"],
                steps["ConnectivityIdOffsets"][step][1],
                lines["NumberOfConnectivityIds"][part],
            )
            out.cells = [ids[a:b] for a, b in zip(offsets[:-1], offsets[1:])]
        return out

    def _load_history(self):
        if self._history is None:
            with open(self.folder / "history.csv", newline="", encoding="utf-8") as file:
                reader = csv.reader(file)
                header = next(reader)
                table = np.array([[float(x) for x in row] for row in reader if len(row) == len(header)])
            table = table.reshape(-1, len(header))
            columns, units = {}, {}
            for number, title in enumerate(header):
                name, _, unit = title.rpartition(" [")
                for key in (name, title):
                    columns[key] = table[:, number]
                    units[key] = unit.rstrip("]")
            names = [title.rpartition(" [")[0] for title in header]
            for title, name in zip(header, names):
                if names.count(name) == 1:
                    del columns[title], units[title]
            self._history = columns, units
        return self._history
