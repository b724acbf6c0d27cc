"""Hold the reference of a scene's keys against the program that reads scenes.

    python3 check_keys.py --program build/release/riven --keys cases/keys.md

Every table of a scene that the program knows must have a section, whose table of keys has all keys that the program
allows there, and no others; every word of a choice must be named in that section; every example must be right within
the scene that the reference begins with. What the program allows it says itself, of a key that it does not know.

A section is that of the tables in its heading: `[solver]`, `[[crack]]`, `[crack.contact]`; `disk`, without brackets, of
all tables of this name that have no section of their own; "Top level" is the scene itself. Its keys stand in the first
column of the Markdown table that begins with "key".
"""

import argparse
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

# One entry of each kind, so that what is below it can be asked for. `load` and `probe` have keys that only some kinds
# have: there is one entry for each of the kinds with choices of their own.
SCENE = """[solver]
time = "1 us"
transfer = "fmpm"
[grid]
cell = "1 mm"
lower = ["-4 mm", "-4 mm"]
upper = ["24 mm", "24 mm"]
[[material]]
name = "m"
E = "1 GPa"
nu = 0.3
density = "1 g/cm^3"
[[body]]
material = "m"
rectangle = { lower = ["0 mm", "0 mm"], upper = ["20 mm", "20 mm"] }
holes = [{ disk = { center = ["5 mm", "5 mm"], radius = "1 mm" } }]
[[grip]]
rectangle = { lower = ["0 mm", "20 mm"], upper = ["20 mm", "21 mm"] }
velocity_x = "0 m/s"
[[fix]]
box = { lower = ["0 mm", "0 mm"], upper = ["20 mm", "0 mm"] }
velocity_y = "0 m/s"
[[symmetry]]
axis = "x"
position = "0 mm"
solid = "above"
[[load]]
kind = "traction"
edge = "top"
rectangle = { lower = ["0 mm", "19 mm"], upper = ["20 mm", "20 mm"] }
traction_x = "0 Pa"
[growth]
toughness = "1 MPa m^0.5"
[[crack]]
points = [["-1 mm", "10 mm"], ["8 mm", "10 mm"]]
contact = { law = "stick" }
traction = { kind = "pressure", pressure = "1 MPa" }
growth = { toughness = "1 MPa m^0.5" }
[fracture]
contour = 4
[[fracture.reading]]
name = "far"
[[probe]]
kind = "stress"
point = ["10 mm", "15 mm"]
[[probe]]
kind = "velocity"
point = ["10 mm", "15 mm"]
"""
UNKNOWN = "no_such_key"
TOP = "Top level"  # heading of the section of the scene itself
NAMED_BY_SCENE = {"material", "target"}  # their choices are names of other entries
REGIONS = ("rectangle", "disk", "polygon")


class Reader:
    """The program, asked what it says of one scene with some settings changed."""

    def __init__(self, program, scene):
        self.command = [program, "check", str(scene)]

    def __call__(self, *settings):
        arguments = [word for s in settings for word in ("--set", s)]
        run = subprocess.run([*self.command, *arguments], capture_output=True, text=True, timeout=60)
        if run.returncode not in (0, 2):
            raise SystemExit(f"{self.command[0]} ended with {run.returncode}: {run.stderr}")
        return run.stderr

    def of_key(self, path, value):
        """What is said of a key with this value; a region in place of the one that the scene has there."""
        said = self(f"{path}={value}")
        if "the region is said twice" in said:
            table, key = path.rsplit(".", 1)
            for other in REGIONS:
                if other != key and "to take away" not in (answer := self(f"{table}.{other}=", f"{path}={value}")):
                    return answer
        return said


def listed(said):
    found = re.search(r"^\s+allowed: (.*)$", said, re.MULTILINE)
    if not found:
        raise SystemExit(f"no list of what is allowed in: {said}")
    return found.group(1).split(", ")


def tables_of(reader):
    """{name of the table: (its keys, {key: words of its choice})}, found from the top down."""
    found = {}
    todo = [("", [""])]  # name, and the paths of the entries that the scene has
    with ThreadPoolExecutor(4) as pool:
        while todo:
            name, paths = todo.pop()
            prefix = [p + "." if p else "" for p in paths]
            keys = listed(reader(f"{prefix[0]}{UNKNOWN}=1"))
            words = {}
            asked = [(p, key) for p in prefix for key in keys]
            answers = pool.map(lambda a: reader.of_key(a[0] + a[1], '"no_such_word"'), asked)
            below = {}
            for (p, key), said in zip(asked, answers):
                if "unknown name 'no_such_word'" in said and key not in NAMED_BY_SCENE:
                    words[key] = listed(said)
                elif "expected a table," in said or "expected an array of tables" in said or key in REGIONS[:2]:
                    array = "expected an array of tables" in said
                    form = f"[{{{UNKNOWN}=1}}]" if array else f"{{{UNKNOWN}=1}}"
                    if f"unknown key '{UNKNOWN}'" in (inside := reader.of_key(p + key, form)):
                        below.setdefault(key, (array, listed(inside), []))[2].append(p + key)
            found[name] = (keys, words)
            for key, (array, inside, at) in below.items():
                whole = f"{name}.{key}" if name else key
                entries = [f"{a}.{i}" for a in at for i in range(entries_of(whole))] if array else at
                if f"unknown key '{UNKNOWN}'" in reader(f"{entries[0]}.{UNKNOWN}=1"):
                    todo.append((whole, entries))
                else:  # a region that the scene has not got there: nothing is below it
                    found[whole] = (inside, {})
    return found


def entries_of(array):
    """How many the scene has of an array of tables; those within an entry are one."""
    return max(1, SCENE.count(f"[[{array}]]"))


def sections_of(text):
    """[(names in the heading, keys of its table, all words in code)]"""
    sections = []
    for part in re.split(r"^(?=##+ )", text, flags=re.MULTILINE)[1:]:
        heading, _, body = part.partition("\n")
        names = re.findall(r"`([^`]+)`", heading) or [heading.lstrip("# ")]
        keys = []
        for block in re.findall(r"(?:^\|.*\n)+", body, flags=re.MULTILINE):
            rows = block.splitlines()
            if rows[0].split("|")[1].strip() == "key":
                for row in rows[2:]:
                    keys += re.findall(r"`([^`]+)`", row.split("|")[1])
        sections.append((names, keys, set(re.findall(r"`([^`]+)`", body))))
    return sections


def section_of(table, sections):
    names = {TOP} if not table else {f"[{table}]", f"[[{table}]]"}
    for exact in (names, {table.rpartition(".")[2]}):
        for section in sections:
            if exact & set(section[0]):
                return section
    return None


def compare(tables, sections):
    faults = []
    used = []
    for table, (keys, words) in sorted(tables.items()):
        shown = table or TOP
        section = section_of(table, sections)
        if section is None:
            faults.append(f"{shown}: a table without a section")
            continue
        used.append(section)
        _, described, code = section
        faults += [f"{shown}: '{key}' is allowed but not described" for key in keys if key not in described]
        faults += [f"{shown}: '{key}' is described but not allowed" for key in described if key not in keys]
        faults += [f"{shown}: '{key}' is described twice" for key in set(described) if described.count(key) > 1]
        for key, choice in words.items():
            faults += [f"{shown}: '{key}' may be '{w}', which is not described" for w in choice if w not in code]
    faults += [f"{names[0]}: a section of no table" for names, keys, _ in sections
               if keys and not any(names is u[0] for u in used)]
    return faults


def examples_of(text):
    """The blocks of code: runs of indented lines, with the empty ones between them."""
    blocks = re.findall(r"(?:^ {4}.*\n(?:\n(?= {4}))?)+", text, flags=re.MULTILINE)
    return [re.sub(r"^ {4}", "", b, flags=re.MULTILINE) for b in blocks]


def with_example(scene, example):
    """The scene with the example added, in place of the tables that both have."""
    own = set(re.findall(r"^\[[\w.]+\]", example, flags=re.MULTILINE))
    parts = re.split(r"^(?=\[)", scene, flags=re.MULTILINE)
    return "".join(p for p in parts if p.split("\n")[0] not in own) + "\n" + example


def try_examples(program, examples, folder):
    faults = []
    if not examples:
        return ["no example"]
    for k, example in enumerate(examples):
        scene = folder / f"example_{k}.toml"
        scene.write_text(example if k == 0 else with_example(examples[0], example), encoding="utf-8")
        said = Reader(program, scene)()
        if said:
            faults.append(f"example {k + 1} is refused: {said.strip()}\n{example}")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True)
    parser.add_argument("--keys", required=True, type=Path)
    arguments = parser.parse_args()
    text = arguments.keys.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scene = folder / "scene.toml"
        scene.write_text(SCENE, encoding="utf-8")
        reader = Reader(arguments.program, scene)
        if said := reader():
            sys.exit(f"the scene of this test is refused: {said}")
        tables = tables_of(reader)
        examples = examples_of(text)
        faults = compare(tables, sections_of(text)) + try_examples(arguments.program, examples, folder)
    for fault in faults:
        print(fault)
    print(f"{len(tables)} tables, {sum(len(keys) for keys, _ in tables.values())} keys, "
          f"{sum(len(w) for _, words in tables.values() for w in words.values())} words, {len(examples)} examples; "
          f"{len(faults)} wrong")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
