"""Draw a frame, or two columns of the history, of a riven run.

    riven picture DIR                                   # von Mises stress, last frame
    riven picture DIR --field sigma_yy --frame 10 -o p.png --magnify 20
    riven picture DIR --curve strain stress             # x column, then one or more y columns
    riven picture DIR --list                            # fields, frames and columns that there are

`riven picture` runs this script, riven_picture.py.

Particles are drawn as the squares they stand for, moved with the body; open cracks as the gap between
their two surfaces. --magnify scales displacements and openings (needs the displacement in the frames).
"""

import argparse
import difflib
import sys
from pathlib import Path

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.collections import PolyCollection
    from matplotlib.ticker import FuncFormatter

    from riven_results import Results
except ModuleNotFoundError as missing:
    print(
        f"riven_picture: {missing}: pictures need NumPy, h5py and Matplotlib for this Python; Debian's are with"
        " /usr/bin/python3. `riven picture` takes the Python that RIVEN_PYTHON names.",
        file=sys.stderr,
    )
    sys.exit(4)

SYMBOLS = {
    "sigma_xx": r"$\sigma_{xx}$",
    "sigma_yy": r"$\sigma_{yy}$",
    "sigma_zz": r"$\sigma_{zz}$",
    "sigma_xy": r"$\sigma_{xy}$",
    "displacement_x": r"$u_x$",
    "displacement_y": r"$u_y$",
    "displacement": r"$|u|$",
    "velocity_x": r"$v_x$",
    "velocity_y": r"$v_y$",
    "velocity": r"$|v|$",
    "von_mises": "von Mises stress",
    "pressure": "pressure",
    "fringe": "fringe",
    "J": "volume ratio $J$",
}
STRESS = {"sigma_xx": 0, "sigma_yy": 1, "sigma_zz": 2, "sigma_xy": 3}
PREFIXES = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "u"), (1e-9, "n"), (1e-12, "p")]


def refuse(message, code=2):
    """Ends with a message and an exit code of riven's: 2 for what was asked, 4 for files."""
    print(f"riven_picture: {message}", file=sys.stderr)
    sys.exit(code)


def refuse_name(kind, name, known):
    """Refuses a name that is none of those known, with the nearest one, or else all."""
    near = difflib.get_close_matches(name, known, 1)
    hint = f"did you mean '{near[0]}'? --list prints all" if near else f"there are: {', '.join(known)}"
    refuse(f"no {kind} '{name}'; {hint}")


def stress_name(name):
    """stress_yy is sigma_yy."""
    sigma = name.replace("stress_", "sigma_", 1)
    return sigma if sigma in STRESS else name


def field(frame, name):
    """Values and unit of a field: an array of the frame, a component of one, or a length."""
    name = stress_name(name)
    if name in STRESS:
        return frame["stress"][:, STRESS[name]], "Pa"
    if name == "pressure":
        return -frame["stress"][:, :3].mean(axis=1), "Pa"
    base, _, axis = name.rpartition("_")
    if axis in ("x", "y") and base in frame:
        return frame[base][:, "xy".index(axis)], frame.units.get(base, "")
    if name not in frame:
        refuse_name("field", name, fields(frame))
    values = frame[name]
    if values.ndim == 2 and values.shape[1] == 3:
        values = np.linalg.norm(values, axis=1)
    if values.ndim != 1:
        refuse(f"'{name}' has {values.shape[1]} components; name one of: {', '.join(fields(frame))}")
    return values, frame.units.get(name, "")


def fields(frame):
    names = ["pressure", *STRESS] if "stress" in frame else []
    for name, values in frame.items():
        if name == "points" or name.startswith("cell:"):
            continue
        if values.ndim == 1 or values.shape[1] == 3:
            names.append(name)
        if values.ndim == 2 and values.shape[1] == 3:
            names += [name + "_x", name + "_y"]
    return sorted(names)


def scaled(values, unit):
    """Values in a unit with the prefix that suits their size."""
    if unit in ("", "1"):
        return values, ""
    finite = np.abs(values[np.isfinite(values)])
    size = finite.max() if finite.size else 0
    for factor, prefix in PREFIXES:
        if size >= 0.9995 * factor and size > 0:
            return values / factor, prefix + unit
    return values, unit


def text_of(value, unit):
    (number,), unit = scaled(np.array([value]), unit)
    return f"{number:.4g} {unit}"


def squares(frame, magnify):
    """Corners (n, 4, 2) of the particles in mm, moved and stretched with the body."""
    center = frame["points"][:, :2].copy()
    if magnify != 1:
        if "displacement" not in frame:
            refuse("--magnify needs the displacement, which these frames do not hold")
        center += (magnify - 1) * frame["displacement"][:, :2]
    half = 0.5 * frame["size"] * 1.01  # a little more than the square: no seams
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)
    offset = half[:, None, None] * corners[None]
    if "deformation_gradient" in frame:
        gradient = frame["deformation_gradient"].reshape(-1, 2, 2)
        gradient = np.eye(2) + magnify * (gradient - np.eye(2))
        offset = np.einsum("nij,ncj->nci", gradient, offset)
    elif magnify == 1:
        offset *= np.sqrt(np.clip(frame["J"], 0.25, 4))[:, None, None]
    else:
        # without the gradient: wide enough to close the gaps that the magnified stretch opens
        offset *= 1 + abs(magnify) * np.quantile(np.abs(frame["J"] - 1), 0.99)
    return 1e3 * (center[:, None, :] + offset)


def surfaces(cracks, magnify):
    """For each crack its upper and its lower surface in mm."""
    first = cracks["first_position"][:, :2]
    for line in cracks.cells:
        yield tuple(
            1e3 * (first[line] + magnify * (cracks[side][line, :2] - first[line])) for side in ("upper", "lower")
        )


def colours(name, values):
    """Colour map and range: about zero for signed fields, without the few largest values at crack tips."""
    finite = values[np.isfinite(values)]
    if finite.size == 0:
        refuse(f"'{name}' holds no finite value in this frame")
    if name == "fringe":
        return "gray", -1, 1, "neither"
    if np.issubdtype(values.dtype, np.integer):
        return "viridis", finite.min() - 0.5, finite.max() + 0.5, "neither"
    low, high = np.quantile(finite, [0.005, 0.995])
    if low < 0 < high and name != "J":
        high = max(-low, high)
        low, map_name = -high, "RdBu_r"
    elif name == "J":
        high = max(abs(low - 1), abs(high - 1), 1e-12)
        low, high, map_name = 1 - high, 1 + high, "RdBu_r"
    else:
        map_name = "viridis"
    if low == high:
        low, high = low - 0.5, high + 0.5
    extend = ("neither", "min", "max", "both")[int(finite.min() < low) + 2 * int(finite.max() > high)]
    return map_name, low, high, extend


def draw_frame(run, name, number, magnify, out, dpi=200):
    frame = run.particles(number)
    values, unit = field(frame, name)
    values, unit = scaled(values, unit)
    map_name, low, high, extend = colours(name, values)
    polygons = squares(frame, magnify)
    lower, upper = polygons.min(axis=(0, 1)), polygons.max(axis=(0, 1))
    width, height = upper - lower
    margin = 0.03 * max(width, height)

    # as large as fits in 8 by 7 inches, and room for the axes and the colour bar
    scale = min(8 / width, 7 / height)
    figure, axes = plt.subplots(figsize=(max(width * scale, 2.5) + 2.2, max(height * scale, 1.5) + 1.2))
    particles = PolyCollection(
        polygons, array=values, cmap=map_name, clim=(low, high), edgecolors="none", antialiaseds=False
    )
    axes.add_collection(particles)
    cracks = run.cracks(number)
    if cracks is not None:
        for above, below in surfaces(cracks, magnify):
            gap = np.vstack([above, below[::-1]])
            axes.fill(*gap.T, facecolor="white", edgecolor="none", zorder=2)
            for line in (above, below):
                axes.plot(*line.T, color="black", linewidth=0.6, solid_capstyle="round", zorder=3)
    axes.set_xlim(lower[0] - margin, upper[0] + margin)
    axes.set_ylim(lower[1] - margin, upper[1] + margin)
    axes.set_aspect("equal")
    axes.set_xlabel("x [mm]")
    axes.set_ylabel("y [mm]")
    label = SYMBOLS.get(stress_name(name), name.replace("_", " "))
    bar = figure.colorbar(particles, ax=axes, extend=extend, fraction=0.046, pad=0.03)
    bar.set_label(f"{label} [{unit}]" if unit else label)
    title = run.summary.get("title") or run.summary.get("scene") or run.folder.resolve().name
    moved = f", displacements x {magnify:g}" if magnify != 1 else ""
    axes.set_title(f"{title}\nt = {text_of(frame.time, 's')}{moved}", fontsize=10)
    figure.savefig(out, dpi=dpi, bbox_inches="tight")
    plt.close(figure)


def draw_curve(run, names, out, dpi=200):
    for name in names:
        if name not in run.history:
            refuse_name("column", name, list(run.history))
    x_name, y_names = names[0], names[1:]

    def axis(columns):
        """Columns that share an axis, in one unit."""
        units = {run.units[n] for n in columns}
        if len(units) > 1:
            refuse(f"columns of different units on one axis: {', '.join(sorted(units))}")
        table = np.array([run.history[n] for n in columns])
        return scaled(table, units.pop())

    (x,), x_unit = axis([x_name])
    y, y_unit = axis(y_names)

    def label(text, unit):
        text = text.replace("_", " ")
        return f"{text} [{unit}]" if unit else text

    figure, axes = plt.subplots(figsize=(6.4, 4.4))
    for name, values in zip(y_names, y):
        axes.plot(x, values, linewidth=1.4, label=name.replace("_", " "))
    axes.set_xlabel(label(x_name, x_unit))
    axes.set_ylabel(label(y_names[0] if len(y_names) == 1 else "", y_unit))
    if not x_unit and np.nanmax(np.abs(x), initial=0) < 0.2 and "strain" in x_name:
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100 * value:g}"))
        axes.set_xlabel(f"{x_name.replace('_', ' ')} [%]")
    if len(y_names) > 1:
        axes.legend(frameon=False)
    axes.grid(alpha=0.3)
    axes.spines[["top", "right"]].set_visible(False)
    axes.set_title(run.summary.get("title") or run.folder.resolve().name, fontsize=10)
    figure.savefig(out, dpi=dpi, bbox_inches="tight")
    plt.close(figure)


def frame_number(text):
    if text == "last":
        return text
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is neither a number nor 'last'") from None


def main(arguments=None):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", metavar="DIR", help="the results of a run")
    parser.add_argument("--field", default="von_mises", help="what colours the particles (default: von_mises)")
    parser.add_argument(
        "--frame", type=frame_number, default="last", help="number of the frame, 0 for the first, or 'last'"
    )
    parser.add_argument("--magnify", type=float, default=1, help="factor on displacements and openings")
    parser.add_argument("--curve", nargs="+", metavar="COLUMN", help="columns of history.csv: x, then y ...")
    parser.add_argument("--list", action="store_true", help="print what there is to draw")
    parser.add_argument("-o", "--out", help="the picture (default: in DIR, named after what it shows)")
    parser.add_argument("--dpi", type=int, default=200)
    options = parser.parse_args(arguments)
    try:
        run = Results(options.folder)
        if options.list:
            print("frames: ", len(run))
            print("fields: ", ", ".join(fields(run.particles(0))) if len(run) else "none")
            print("columns:", ", ".join(run.history))
            return
        if options.curve:
            if len(options.curve) < 2:
                refuse("--curve takes a column for x and at least one for y")
            out = options.out or Path(options.folder) / f"{options.curve[1]}_over_{options.curve[0]}.png"
            draw_curve(run, options.curve, out, options.dpi)
        else:
            if len(run) == 0:
                refuse(f"{options.folder}: no frames")
            number = len(run) - 1 if options.frame == "last" else options.frame
            if not -len(run) <= number < len(run):
                refuse(f"no frame {number}; there are {len(run)}, from 0")
            out = options.out or Path(options.folder) / f"{options.field}_{number % len(run):06d}.png"
            draw_frame(run, options.field, number, options.magnify, out, options.dpi)
        print(out)
    except OSError as error:
        refuse(error, 4)
    except (KeyError, ValueError) as error:
        refuse(error)


if __name__ == "__main__":
    main()
