"""Open the results of a riven run with VTK's own readers, as ParaView does, and compare them with the frames.

    python check_vtk.py RESULT_DIR

Needs vtk >= 9.3, h5py and numpy. Reads particles.vtkhdf and cracks.vtkhdf step by step with vtkHDFReader, every
frame by itself, and the .pvd and .vtp sidecars where there are any; every point, cell and array must be the one
that h5py finds in the frame, bit for bit.
"""

import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

KINDS = {"particles": "Vertices", "cracks": "Lines"}
checks = 0


def require(condition, what):
    global checks
    checks += 1
    if not condition:
        sys.exit(f"check_vtk: {what}")


def frames(folder, prefix):
    found = [p for p in (folder / "frames").glob(f"{prefix}_*.vtkhdf") if re.fullmatch(r".*_\d+", p.stem)]
    return sorted(found, key=lambda p: int(p.stem.rsplit("_", 1)[1]))


def expected(path, kind):
    """A frame as h5py sees it: time, points, offsets, connectivity, point and cell arrays."""
    with h5py.File(path, "r") as file:
        root = file["VTKHDF"]
        cells = root[kind]
        return (
            float(root["Steps/Values"][0]),
            root["Points"][:],
            cells["Offsets"][:],
            cells["Connectivity"][:],
            {name: d[:] for name, d in root["PointData"].items()},
            {name: d[:] for name, d in root["CellData"].items()},
        )


def arrays(attributes):
    return {
        attributes.GetArrayName(k): vtk_to_numpy(attributes.GetArray(k))
        for k in range(attributes.GetNumberOfArrays())
        if attributes.GetArray(k) is not None
    }


def compare(where, data, kind, frame):
    _, points, offsets, connectivity, point_arrays, cell_arrays = frame
    require(data.GetClassName() == "vtkPolyData", f"{where}: {data.GetClassName()}, not vtkPolyData")
    require(data.GetNumberOfPoints() == len(points), f"{where}: {data.GetNumberOfPoints()} points, not {len(points)}")
    if len(points):
        require(np.array_equal(vtk_to_numpy(data.GetPoints().GetData()), points), f"{where}: other points")
    counts = {"Vertices": data.GetNumberOfVerts(), "Lines": data.GetNumberOfLines()}
    for other, count in counts.items():
        wanted = len(offsets) - 1 if other == kind else 0
        require(count == wanted, f"{where}: {count} cells in {other}, not {wanted}")
    require(data.GetNumberOfCells() == len(offsets) - 1, f"{where}: {data.GetNumberOfCells()} cells")
    cells = data.GetLines() if kind == "Lines" else data.GetVerts()
    if len(offsets) > 1:
        require(np.array_equal(vtk_to_numpy(cells.GetOffsetsArray()), offsets), f"{where}: other offsets")
        require(np.array_equal(vtk_to_numpy(cells.GetConnectivityArray()), connectivity), f"{where}: other cells")
    for group, wanted, attributes in (
        ("point", point_arrays, data.GetPointData()),
        ("cell", cell_arrays, data.GetCellData()),
    ):
        found = arrays(attributes)
        require(set(found) >= set(wanted), f"{where}: {group} arrays {sorted(found)}, not {sorted(wanted)}")
        for name, values in wanted.items():
            require(found[name].shape == values.shape, f"{where}: {name} has shape {found[name].shape}")
            require(np.array_equal(found[name], values, equal_nan=True), f"{where}: other values in {name}")


def poly_data(output):
    """The reader's output, out of the partitioned data set that some versions put around it."""
    while output is not None and output.GetClassName() != "vtkPolyData" and hasattr(output, "GetPartition"):
        require(output.GetNumberOfPartitions() == 1, f"{output.GetNumberOfPartitions()} partitions, not 1")
        output = output.GetPartition(0)
    return output


def check_series(path, kind, wanted, order):
    """One VTKHDF file with the given frames as its steps, visited in the given order."""
    require(vtkHDFReader().CanReadFile(str(path)), f"{path}: vtkHDFReader cannot read it")
    reader = vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    information = reader.GetOutputInformation(0)
    times = [information.Get(key, k) for k in range(information.Length(key))]
    # the reader announces no times for a single step
    require(times == ([frame[0] for frame in wanted] if len(wanted) > 1 else []), f"{path}: time steps {times}")
    for step in order:
        reader.UpdateTimeStep(times[step]) if times else reader.Update()
        compare(f"{path} at step {step}", poly_data(reader.GetOutputDataObject(0)), kind, wanted[step])


def check_sidecars(folder, prefix, kind, wanted):
    index = folder / f"{prefix}.pvd"
    if not index.is_file():
        return 0
    entries = ElementTree.parse(index).getroot().findall("./Collection/DataSet")
    require([float(e.get("timestep")) for e in entries] == [f[0] for f in wanted], f"{index}: other times")
    for entry, frame in zip(entries, wanted):
        path = index.parent / entry.get("file")
        reader = vtkXMLPolyDataReader()
        require(reader.CanReadFile(str(path)), f"{path}: vtkXMLPolyDataReader cannot read it")
        reader.SetFileName(str(path))
        reader.Update()
        compare(path, reader.GetOutput(), kind, frame)
        require(float(vtk_to_numpy(reader.GetOutput().GetFieldData().GetArray("TimeValue"))[0]) == frame[0],
                f"{path}: other time")
    return len(entries)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    for prefix, kind in KINDS.items():
        paths = frames(folder, prefix)
        if not paths:
            require(prefix != "particles", f"{folder}: no frames of particles")
            continue
        wanted = [expected(path, kind) for path in paths]
        for path, frame in zip(paths, wanted):
            check_series(path, kind, [frame], [0])
        steps = list(range(len(wanted)))
        # forwards, backwards and to and fro: what a reader keeps from the step before must not show
        check_series(folder / f"{prefix}.vtkhdf", kind, wanted, steps + steps[::-1] + [steps[-1], 0])
        sidecars = check_sidecars(folder, prefix, kind, wanted)
        counts = [len(frame[1]) for frame in wanted]
        print(f"{prefix}: {len(wanted)} steps of {min(counts)} to {max(counts)} points, {sidecars} sidecars")
    print(f"check_vtk: VTK {vtkVersion().GetVTKVersion()} agrees, {checks} checks")


if __name__ == "__main__":
    main()
