"""Hold the advice of `riven advise` against what it promises: plates with an edge crack, of random size, material, crack
and load, whose J the closed form gives.

    python3 check_advice.py build/release/riven --seed 7 --scenes 5 --within 5%

Each plate is pulled slowly by tractions and damped, so that J at the end is K^2/E with
K = sigma sqrt(pi a) (1.122 - 0.231 r + 10.55 r^2 - 21.72 r^3 + 30.39 r^4), r = a/W (H. Tada, P.C. Paris and G.R. Irwin,
"The Stress Analysis of Cracks Handbook", 0.5 % for r up to 0.6). The advised cell is run, and its J and its time are
held against the closed form and the prediction. Fails when more than one in five scenes misses the tolerance, or the
time by more than 40 % (--no-times leaves times out, for a machine that is busy).
"""

import argparse
import json
import math
import random
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SCENE = """title = "edge crack"
[solver]
time = "{time} s"
plane = "stress"
thickness = "1 mm"
transfer = "fmpm"
order = 1
[grid]
cell = "{cell} m"
lower = ["{left} m", "{bottom} m"]
upper = ["{right} m", "{top} m"]
[[material]]
name = "plate"
E = "{E} Pa"
nu = {nu}
density = "{density} kg/m^3"
[[body]]
name = "plate"
material = "plate"
rectangle = {{ lower = ["0 m", "{low} m"], upper = ["{W} m", "{high} m"] }}
[[load]]
name = "top"
kind = "traction"
edge = "top"
rectangle = {{ lower = ["0 m", "0 m"], upper = ["{W} m", "{high} m"] }}
traction_y = {{ value = "{sigma} Pa", shape = "t < tr ? t/tr : 1", tr = "{ramp} s" }}
[[load]]
name = "bottom"
kind = "traction"
edge = "bottom"
rectangle = {{ lower = ["0 m", "{low} m"], upper = ["{W} m", "0 m"] }}
traction_y = {{ value = "-{sigma} Pa", shape = "t < tr ? t/tr : 1", tr = "{ramp} s" }}
[[crack]]
name = "edge"
points = [["-{cell} m", "0 m"], ["{a} m", "0 m"]]
[damping]
grid = "{damping} 1/s"
[fracture]
contour = 4
[output]
frames = 0
"""


def draw(numbers):
    """A plate, and its J."""
    width = numbers.choice([10e-3, 20e-3, 45e-3, 80e-3])
    cells = numbers.choice([16, 20, 24])
    cell = width / cells
    half = cell * round(1.5 * cells / 2) * 2
    crack = width * numbers.uniform(0.3, 0.55)
    E = 10 ** numbers.uniform(8, 11)
    nu = numbers.uniform(0.1, 0.4)
    density = numbers.uniform(800, 8000)
    sigma = 1e-3 * E * numbers.uniform(0.2, 1)
    speed = math.sqrt(E / density)
    period = 4 * half / speed
    r = crack / width
    shape = 1.122 - 0.231 * r + 10.55 * r**2 - 21.72 * r**3 + 30.39 * r**4
    J = sigma**2 * math.pi * crack * shape**2 / E
    text = SCENE.format(
        time=6 * period, cell=cell, left=-2 * cell, right=width + 2 * cell, bottom=-half - 2 * cell, top=half + 2 * cell,
        E=E, nu=nu, density=density, low=-half, high=half, W=width, a=crack, sigma=sigma, ramp=3 * period,
        damping=2 / period,
    )
    return text, J


def advise(program, scene, within, folder, threads):
    command = [program, "advise", scene, "--within", within, "--quiet", "--result", "edge last J"]
    out = subprocess.run(
        [*command, "--threads", threads, "-o", str(folder / "advice")], check=True, capture_output=True, text=True
    ).stdout
    settings = re.findall(r"--set '([^']*)'", out)
    expected = float(re.search(r"expected error ([\d.e+-]+) %", out).group(1)) / 100
    seconds = float(re.search(r"predicted time ([\d.e+-]+) s", out).group(1))
    return settings, expected, seconds, "within" in out and "does not come within" not in out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scenes", type=int, default=5)
    parser.add_argument("--within", default="5%")
    parser.add_argument("--threads", default="2")
    parser.add_argument("--no-times", action="store_true")
    arguments = parser.parse_args()
    tolerance = float(arguments.within.rstrip("%")) / 100
    missed = slow = 0
    for k in range(arguments.scenes):
        seed = 1000 * arguments.seed + k
        text, J = draw(random.Random(seed))
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            scene = folder / "plate.toml"
            scene.write_text(text, encoding="utf-8")
            settings, expected, predicted, reached = advise(
                arguments.program, str(scene), arguments.within, folder, arguments.threads
            )
            sets = [word for s in settings for word in ("--set", s)]
            began = time.monotonic()
            subprocess.run(
                [arguments.program, "run", str(scene), "--quiet", "--threads", arguments.threads, "-o",
                 str(folder / "run"), *sets],
                check=True,
            )
            seconds = time.monotonic() - began
            tips = json.loads((folder / "run" / "summary.json").read_text(encoding="utf-8"))["tips"]
        found = next(t["J"] for t in tips if t["end"] == "last")
        error = abs(found / J - 1)
        off = seconds / predicted - 1
        missed += not (reached and error <= tolerance)
        slow += abs(off) > 0.4
        print(
            f"seed {seed}: {settings[0]}, J off by {100 * error:.2f} % (expected {100 * expected:.2g} %), "
            f"{seconds:.2f} s, {100 * off:+.0f} % beside the prediction"
        )
    print(f"{missed} of {arguments.scenes} missed the tolerance of {arguments.within}, {slow} the time")
    if missed > arguments.scenes // 5 or (slow > arguments.scenes // 5 and not arguments.no_times):
        sys.exit(1)


if __name__ == "__main__":
    main()
