"""Install riven, move what was installed, and use it: it must find its scenes and scripts beside itself.

    python3 check_install.py CMAKE BUILD FOLDER

FOLDER is made anew. That nothing is taken from the sources shows in a scene that only the installed folder lacks.
"""

import shutil
import subprocess
import sys
from pathlib import Path


def require(condition, what):
    if not condition:
        sys.exit(f"check_install: {what}")


def main():
    cmake, build, folder = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([cmake, "--install", build, "--prefix", folder / "first"], check=True, stdout=subprocess.DEVNULL)
    home = folder / "moved"
    (folder / "first").rename(home)

    def riven(*words):
        return subprocess.run([home / "bin" / "riven", *words], cwd=folder, capture_output=True, text=True)

    for document in ("README.md", "keys.md", "study_keys.md", "LICENSE"):
        require((home / "share/doc/riven" / document).is_file(), f"{document} is not installed")
    (home / "share/riven/scenes/dent.toml").unlink()
    names = [line.split()[0] for line in riven("cases").stdout.splitlines()]
    require("sent" in names and "ten_cracks" in names, f"the shipped scenes are {names}")
    require("dent" not in names, "the shipped scenes are those of the sources")

    copied = riven("cases", "ten_cracks", "--copy")
    require(copied.stdout.split() == ["ten_cracks.csv", "ten_cracks.toml"], copied.stdout + copied.stderr)
    run = riven("run", "ten_cracks.toml", "-o", "out", "--set", "solver.time=2 us", "--set", "output.frames=1")
    require(run.returncode == 0 and "riven picture out" in run.stdout, run.stdout + run.stderr)
    drawn = riven("picture", "out", "-o", "p.png", "--dpi", "50")
    require(drawn.returncode == 0 and (folder / "p.png").stat().st_size > 1000, drawn.stdout + drawn.stderr)
    for words, code, message in (
        (["out", "--field", "displacment"], 2, "did you mean 'displacement'?"),
        (["nowhere"], 4, "nowhere"),
    ):
        refused = riven("picture", *words)
        require(refused.returncode == code and message in refused.stderr, f"{words}: {refused.returncode}, {refused.stderr}")
    studies = riven("study", "--list")
    require("sent_j" in studies.stdout, studies.stdout + studies.stderr)


if __name__ == "__main__":
    main()
