#!/usr/bin/env python3
"""blocks.py PROGRAM ROOT [PAGE…]: every code block of README.md, CONTRIBUTING.md and docs/**.md does what its page says.

How a block is recognised. A fence names its language, one of those in FENCES; another is an error. An indented block is, in this order, TOML, JSON
or Python if it parses as such, C++ if a line ends in ; or {, a formula or a drawing if it has their signs outside comments, else commands
of a shell. So a misspelt command is a failure, not another language.

    TOML     parsed. A whole robot is given to `rehearse check`, a whole campaign to `rehearse campaign --dry-run`.
             Keys of a part of a robot's file must be in the schema of `rehearse list --schema`.
    JSON     parsed.
    Python   compiled, and where the module is built (PYTHONPATH) run: a page's blocks in one namespace, in its folder, after its
             other blocks, with small budgets and names that stand for a reader's own (small_module.py), within 60 s.
    CSV      has as many values in each line as in the first.
    C++, C, CMake   not compiled: a unit takes a compiler ten seconds and more, and most blocks are parts of a program. Their whole
             programs are: examples/own_robot and own_learner by tests/install, examples/same_robot by tests/examples,
             exported policies by tests/cli/export.sh. cpp.py compiles blocks of C++ at night.
    text, formulas, drawings    passed over.
    shell    run by bash, each page's blocks in one folder of their own, in order, with `set -e`.

A shell finds there: `rehearse` and `build/release/rehearse` are the program with small budgets (small_budget.py: `learn` does at
most one trial with searches of 100 rollouts, `campaign` checks alone, options count as they stand); campaigns, examples, presets and
results are the repository's; runs/demo (three trials) and runs/short (a campaign), my_robot.toml, the logs log1.csv to log3.csv and
episode.csv, policy.json and mine.toml are there. The words S, P, N, FILE, RUN stand for 1, useful, 100, a robot's file, runs/demo. ./demo is
the program. Benchmarks, the repository's scripts and ./check must exist, and do nothing; nor do cmake, ctest, mpirun, npm, pip, sbatch, srun.

A block that cannot run has the comment `<!-- not run: WHY -->` before it; it is counted.
"""
import ast
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import tomllib
except ImportError:
    sys.exit(print("skipped: Python 3.11 or later was not found"))

sys.dont_write_bytecode = True
import small_budget  # noqa: E402

STANDS_FOR = {"S": "1", "P": "useful", "N": "100", "FILE": "examples/robots/pendulum.toml", "FILE.toml": "examples/robots/pendulum.toml",
              "RUN": "runs/demo"}
FENCES = {"python", "toml", "cpp", "c", "cmake", "sh", "bash", "json", "csv", "text"}
PLACEHOLDER = re.compile(r"(?<=[ =])(FILE\.toml|FILE|RUN|S|P|N)(?=[ ;]|$)", re.M)
IDLE = ["cmake", "ctest", "mpirun", "npm", "pip", "sbatch", "srun"]
SHARED = ["bin", "build", "scripts"]  # the same for all pages
SIGNS = re.compile(r"[│─└┘├┤┐Σφθℓσμεπτ²½√ᵀ⁻−∂∫Δ→↦·∈≤′Φ]")
MARK = re.compile(r"<!-- not run: .+ -->")


# Blocks, and what they are.

def blocks(path):
    """Line, language ("" of an indented one), text, and whether it is marked as not run."""
    lines = path.read_text().split("\n")
    at, marked = 0, False
    while at < len(lines):
        line, begin = lines[at], at
        if fence := re.match(r" *(```+) *([^\s{]*)", line):
            at += 1
            while at < len(lines) and lines[at].strip() != fence[1]:
                at += 1
            yield begin + 1, fence[2] or "text", "\n".join(lines[begin + 1:at]), marked
            marked = False
        elif line.startswith("    ") and (at == 0 or not lines[at - 1].strip()):
            while at < len(lines) and (lines[at].startswith("    ") or not lines[at].strip()):
                at += 1
            yield begin + 1, "", "\n".join(text[4:] for text in lines[begin:at]).rstrip(), marked
            at, marked = at - 1, False
        elif line.strip():
            marked = bool(MARK.fullmatch(line.strip()))
        at += 1


def parses(parse, text):
    try:
        return parse(text) is not None
    except (ValueError, SyntaxError):
        return False


def kind(text):
    if parses(tomllib.loads, text):
        return "toml"
    if all(parses(json.loads, line) for line in text.split("\n")):
        return "json"
    if re.search(r"[(=]|import ", text) and parses(ast.parse, text):
        return "python"
    if re.search(r"[;{}]( *//.*)?$", text, re.M):
        return "cpp"
    if SIGNS.search(re.sub(r"(^|\s)#.*", "", text)):
        return "signs"
    return "cmake" if re.fullmatch(r"\w+\([^\n]*\)", text) else "sh"


def parts(line, language, text):
    """A block, or its paragraphs where they are of several kinds."""
    if language:
        yield line, language, text
    elif kind(text) != "sh":
        yield line, kind(text), text
    else:
        for paragraph in re.finditer(r"(?:.+\n?)+", text):
            yield line + text[:paragraph.start()].count("\n"), kind(paragraph[0].rstrip("\n")), paragraph[0].rstrip("\n")


# A folder to work in.

def write(path, text, executable=False):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    if executable:
        path.chmod(0o755)


def say(*command, **more):
    return subprocess.run(command, check=True, capture_output=True, text=True, **more).stdout


def fixtures(program, root, folder):
    """What every page's folder begins with; made once."""
    run = small_budget.options(small_budget.SMALL) + ["--threads", "1"]
    say(program, "learn", "pendubot", "--learner", "gp-mi", "--prior", "misleading", "--trials", "3", "--out", "runs/demo", *run, cwd=folder)
    say(program, "export", "runs/demo", "--out", "policy.json", cwd=folder)
    say(program, "new", "my_robot", cwd=folder)
    run += ["--set", "start_from_best=false"]  # a policy that is repeated would make the same log twice
    say(program, "learn", "my_robot.toml", "--learner", "black-drops", "--trials", "4", "--out", "runs/my_robot", *run, cwd=folder)
    for name, trial in (("log1", 1), ("log2", 2), ("log3", 3), ("episode", 4)):
        shutil.copy(folder / f"runs/my_robot/trajectories/trial-00{trial}.csv", folder / f"{name}.csv")
    shutil.rmtree(folder / "runs/my_robot")
    write(folder / "mine.toml", "format = 1\n[set]\nsearch.box = 4\n")
    options = "".join(f"{o.replace('=', ' = ')}\n" for o in small_budget.SMALL)
    write(folder / "short.toml", f'format = 1\nscenario = "pendulum"\nlearners = ["mi"]\nseeds = "1"\ntrials = 1\n[set]\n{options}')
    say(program, "campaign", "short.toml", "--out", "runs/short", "--threads", "1", cwd=folder)
    for name in ("campaigns", "examples", "presets", "results"):
        (folder / name).symlink_to(root / name)
    for path in ("bin/rehearse", "build/release/rehearse"):
        write(folder / path, f'#!/bin/sh\nexec "{sys.executable}" -IS "{small_budget.__file__}" "$@"\n', True)
    write(folder / "demo", '#!/bin/sh\n[ $# -eq 0 ] || exec build/release/rehearse "$@"\n', True)
    nothing = [f"bin/{name}" for name in IDLE] + ["check", "build/own/own_robot"]
    nothing += [f"scripts/{p.name}" for p in (root / "scripts").iterdir() if p.is_file()]
    nothing += [f"build/release/benchmarks/{p.stem}{end}" for p in (root / "benchmarks").glob("*.cpp") for end in ("", "_benchmark")]
    for path in nothing:
        write(folder / path, "#!/bin/sh\n", True)
    (folder / "web").mkdir()


def copy(source, target):
    """Copies a file, and links a program: one that is written while another thread starts a process is busy, and cannot be run."""
    if os.access(source, os.X_OK):
        os.symlink(source, target)
    else:
        shutil.copy2(source, target)


class Checker:
    def __init__(self, program, root, ready):
        self.program, self.root, self.ready = program, root, ready
        self.module = subprocess.run([sys.executable, "-c", "import rehearse"], capture_output=True).returncode == 0
        self.keys = set()
        self.collect(json.loads(say(program, "list", "--schema")))

    def collect(self, schema):
        if isinstance(schema, dict):
            self.keys |= set(schema.get("properties", {}))
            for value in schema.values():
                self.collect(value)
        elif isinstance(schema, list):
            for value in schema:
                self.collect(value)

    def page(self, path):
        """What is wrong with a page, and how many blocks of each kind it has."""
        wrong, counts, python = [], {}, []
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name) / "page"
            for line, language, text, marked in blocks(path):
                for at, what, part in parts(line, language, text):
                    what = "not run" if marked else what
                    counts[what] = counts.get(what, 0) + 1
                    if message := self.block(what, part, folder):
                        wrong.append(f"{path.relative_to(self.root)}:{at}: {message}")
                    elif what == "python":
                        python.append((at if language else at - 1, part))  # lines before it
            if python and self.module and (message := self.run_python(path.name, python, folder)):
                wrong.append(message)
        return wrong, counts

    def block(self, what, text, folder):
        if what in ("sh", "bash"):
            return self.shell(text, folder)
        if what == "toml":
            return self.toml(text, folder)
        if what not in FENCES | {"signs", "not run"}:
            return f"no language of a block: {what}"
        try:
            if what == "python":
                compile(text, "block", "exec")
            elif what == "csv" and len({line.count(",") for line in text.split("\n")}) > 1:
                return "lines of different lengths"
            elif what == "json":
                [json.loads(line) for line in text.split("\n")]
        except (SyntaxError, ValueError) as error:
            return str(error)
        return None

    def furnish(self, folder):
        if not folder.exists():
            shutil.copytree(self.ready, folder, symlinks=True, ignore=shutil.ignore_patterns(*SHARED), copy_function=copy)
            for name in SHARED:
                (folder / name).symlink_to(self.ready / name)

    def run_python(self, page, python, folder):
        self.furnish(folder)
        script = pathlib.Path(__file__).with_name("small_module.py")
        try:
            done = subprocess.run([sys.executable, script, page], input=json.dumps(python), cwd=folder, capture_output=True, text=True,
                                  timeout=60, env={**os.environ, "MPLBACKEND": "agg", "PYTHONDONTWRITEBYTECODE": "1"})
        except subprocess.TimeoutExpired:
            return f"{page}: Python blocks take more than 60 s"
        return f"{page}: Python blocks:\n{done.stderr[-1500:]}" if done.returncode else None

    def shell(self, text, folder):
        self.furnish(folder)
        text = PLACEHOLDER.sub(lambda match: STANDS_FOR[match[1]], text)
        there = {**os.environ, "PROGRAM": self.program, "PATH": f"{folder}/bin:{os.environ['PATH']}", "REHEARSE_CACHE": "off",
                 "REHEARSE": f"{folder}/bin/rehearse"}
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", text], cwd=folder, env=there, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL)
        return f"exit status {done.returncode} of\n{text}\n{done.stdout[-500:]}{done.stderr[-1500:]}" if done.returncode else None

    def toml(self, text, folder):
        try:
            table = tomllib.loads(text)
        except ValueError as error:
            return str(error)
        if "format" in table and ("dt_s" in table or "scenario" in table):
            command = "check block.toml" if "dt_s" in table else "campaign block.toml --out block"
            return self.shell(f"cat >block.toml <<'END'\n{text}\nEND\nrehearse {command}", folder)
        unknown = [key for part in ("state", "action", "limit", "body") for entry in table.get(part, ()) for key in entry
                   if key not in self.keys]
        unknown += [key for part in ("reward", "success", "plant") for key in table.get(part, ()) if key not in self.keys]
        unknown += [key for entry in table.get("dynamics", {}).values() for key in entry if key not in self.keys]
        return f"no key of a robot's file: {', '.join(unknown)}" if unknown else None


def main():
    program, root = os.path.realpath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    pages = [pathlib.Path(name).resolve() for name in sys.argv[3:]]
    pages = pages or [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").rglob("*.md"))]
    os.environ["REHEARSE_CACHE"] = "off"
    total = {}
    with tempfile.TemporaryDirectory() as name:
        ready = pathlib.Path(name)
        fixtures(program, root, ready)
        checker = Checker(program, root, ready)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            results = list(pool.map(checker.page, pages))
    for _, counts in results:
        for what, count in counts.items():
            total[what] = total.get(what, 0) + count
    wrong = [text for found, _ in results for text in found]
    print("\n\n".join(wrong))
    print("Python is run" if checker.module else "Python is compiled alone: its module is not built")
    print(f"{len(pages)} pages, blocks: " + ", ".join(f"{count} {what}" for what, count in sorted(total.items())) + f"; {len(wrong)} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
