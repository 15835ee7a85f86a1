"""Does the test suite catch mistakes? Makes small mistakes (mutants), and runs the tests on each mutant.

    mutate.py [--seed 1] [--count 160] [--only FILE] [--list] [--report] …      README.md here explains

All mutants are built at once, into one program. An environment variable states which mutant is switched on.
A first run of every test records the mutants that the test evaluates. Only these tests then run on a mutant.
If the command is stopped, the same command continues from there.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent

# Share of the mutants in each room, %.
ROOMS = {"lib/bendlab/constraints": 12, "lib/bendlab/bending": 12, "lib/bendlab/effects": 12,
         "lib/bendlab/solver": 13, "lib/bendlab/mesh": 8, "lib/bendlab/metrics": 7, "lib/bendlab/io": 5,
         "experiments/measures": 10, "experiments/config": 9, "experiments/run": 7, "lib/bendlab/scene": 3,
         "experiments/campaign": 2}
# Weight of an operator in the draw where a line offers several operators; 1 for all other operators.
WEIGHTS = {"early return": 0.3, "removal": 0.8, "boundary": 0.6}
# Tests that never run the program, or only measure its speed, or kill it.
NOT_RUN = (r"^(install|trust_kills|trust_shards|performance|analysis|claim_map|where|"
           r"map_rules|stated_numbers)$")


def say(*words):
    print(*words, file=sys.stderr, flush=True)


class Work:
    """The folder of all files: the copy of the sources, its build, the results so far."""

    def __init__(self, options):
        self.folder = Path(options.work).resolve()
        self.tree = Path(options.tree).resolve() if options.tree else self.folder / "tree"
        self.build = Path(options.build).resolve() if options.build else self.folder / "build"
        self.folder.mkdir(parents=True, exist_ok=True)
        self.mutants_file = self.folder / "mutants.json"
        self.lock = threading.Lock()

    def lines(self, name):
        file = self.folder / name
        return [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []

    def add_line(self, name, row):
        with self.lock, open(self.folder / name, "a") as file:
            file.write(json.dumps(row, ensure_ascii=False) + "\n")


# ---- the copy

def copy(root, tree, names=None):
    """Copies the files that git knows or would add. An unchanged file keeps its time, so is not rebuilt."""
    if names is None:
        listed = subprocess.run(
            ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
            cwd=root, check=True, capture_output=True).stdout
        names = [name.decode() for name in listed.split(b"\0") if name]
    for name in names:
        source, target = root / name, tree / name
        if source.is_file() and not (target.exists() and target.read_bytes() == source.read_bytes()):
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, target)


# ---- choosing

def sources(tree, room, only):
    files = sorted(file for file in (tree / room).rglob("*.[ch]pp") if file.is_file())
    if only:
        files = [file for file in files if str(file.relative_to(tree)) in only or file.name in only]
    return files


def code_lines(file):
    """The numbers of the lines that are neither empty, nor a comment, nor an include."""
    return [number for number, line in enumerate(file.read_text().splitlines(), 1)
            if not re.match(r"\s*(//.*|#.*|[{}();]*|namespace .*|}.*// namespace.*)?$", line)]


def compile_flags(work, file):
    """The compiler flags that libclang needs for the file. A header, and a file in a unity build, takes the
    flags of another file in the same folder."""
    entries = json.loads((work.build / "compile_commands.json").read_text())
    own = [entry for entry in entries if entry["file"] == str(file)]
    room = str(file.relative_to(work.tree)).split("/")[:2]
    beside = [entry for entry in entries if "/".join(room) in entry["file"]
              or (room[0] == "experiments" and "bendlab_experiments.dir" in entry["command"])]
    words = shlex.split((own or beside)[0]["command"])
    flags, system = [], []
    for at, word in enumerate(words):
        if word.startswith(("-I", "-D", "-std=", "-march=")):
            flags.append(word)
        elif word == "-isystem":
            system += [word, words[at + 1]]
    # A header gets the system folders of all sources of its room.
    for entry in beside if file.suffix == ".hpp" else []:
        words = shlex.split(entry["command"])
        system += [w for at, word in enumerate(words) if word == "-isystem" for w in (word, words[at + 1])]
    return flags + system + ["-x", "c++", "-w"]


def candidates(work, file):
    """All possible changes of the file. They are searched once and kept, as libclang takes seconds."""
    from sites import Finder
    script = HERE / "sites.py"
    key = hashlib.sha256(file.read_bytes() + script.read_bytes()).hexdigest()[:16]
    kept = work.folder / "sites" / f"{file.name}.{key}.json"
    if not kept.exists():
        kept.parent.mkdir(exist_ok=True)
        kept.write_text(json.dumps(Finder(file, compile_flags(work, file)).mutants, ensure_ascii=False))
    return json.loads(kept.read_text())


def overlap(left, right):
    return left["file"] == right["file"] and any(
        a[0] < b[1] and b[0] < a[1] or a[0] == b[0] for a in left["edits"] for b in right["edits"])


def draw(chance, lines, changes_of):
    """Draws a line of code at random, then a change that begins in this line."""
    file, number = chance.choice(lines)
    changes = [change for change in changes_of(file) if change["line"] == number]
    if not changes:
        return None
    operators = sorted({change["operator"] for change in changes})
    operator = chance.choices(operators, [WEIGHTS.get(name, 1) for name in operators])[0]
    return file, chance.choice([change for change in changes if change["operator"] == operator])


def choose(work, options):
    chance = random.Random(options.seed)
    chosen = []
    changes_of = lambda file: candidates(work, file)  # noqa: E731
    total = sum(ROOMS.values())
    for room, share in ROOMS.items():
        files = sources(work.tree, room, options.only)
        lines = [(file, number) for file in files for number in code_lines(file)]
        if not lines:
            continue
        wanted = options.count if options.only else round(options.count * share / total)
        mine, tries = [], 0
        while len(mine) < wanted and tries < 40 * wanted:
            tries += 1
            drawn = draw(chance, lines, changes_of)
            if drawn is None:
                continue
            mutant = {"room": room, "file": str(drawn[0].relative_to(work.tree)), **drawn[1]}
            if not any(overlap(mutant, earlier) for earlier in mine):
                mine.append(mutant)
                say(
                    f"{room}: {len(mine)} of {wanted}  {mutant['file']}:{mutant['line']} "
                    f"{mutant['operator']}")
        chosen += mine
    for number, mutant in enumerate(chosen, 1):
        mutant["number"] = number
    return chosen


# ---- rewriting and building

def rewritten(original, mutants, header):
    """The bytes of the file with all these mutants, and for each line the numbers of its mutants."""
    from sites import ON
    text, last, owners = [b""], len(original), []
    edits = sorted(((*edit, mutant["number"])
                   for mutant in mutants for edit in mutant["edits"]), reverse=True)
    for begin, end, new, number in edits:
        text.append(original[end:last])
        text.append(new.replace(ON, f"::bendlab_mutant({number})").encode())
        owners.append((begin, number))
        last = begin
    text.append(original[:last])
    whole = f'#include "{header}"\n'.encode() + b"".join(reversed(text))
    where = {}
    for piece in re.finditer(rb"::bendlab_mutant\((\d+)\)", whole):
        where.setdefault(whole.count(b"\n", 0, piece.start()) + 1, set()).add(int(piece[1]))
    return whole, where


def lay_out(work, mutants, keep_times=False):
    """Writes the changed sources into the copy. Returns {file: {line: numbers}}. Objects that did compile are
    still right where mutants were only taken out. Files that keep their time are not built again."""
    shutil.copy2(HERE / "mutant.hpp", work.folder / "mutant.hpp")
    header = work.folder / "mutant.hpp"
    places = {}
    for name in sorted({mutant["file"] for mutant in mutants}):
        target, kept = work.tree / name, work.folder / "originals" / name
        if not kept.exists():
            kept.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(target, kept)
        mine = [mutant for mutant in mutants if mutant["file"] == name and not mutant.get("dropped")]
        text, where = rewritten(kept.read_bytes(), mine, header) if mine else (kept.read_bytes(), {})
        places[str(target)] = where
        if target.read_bytes() != text:
            times = target.stat()
            target.write_bytes(text)
            if keep_times:
                os.utime(target, ns=(times.st_atime_ns, times.st_mtime_ns))
    return places


def configure(work, options):
    if not (work.build / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "-S", work.tree, "-B", work.build, "-G",
                       "Ninja", "-DCMAKE_BUILD_TYPE=Release"], check=True)


def compile_all(work, options):
    log = work.folder / "build.log"
    with open(log, "w") as file:
        done = subprocess.run(["ninja", "-C", work.build, "-k", "0", "-j", str(options.build_jobs),
                               "bendlab_program", "bendlab_tests", "bendlab_library_tests"],
                              stdout=file, stderr=subprocess.STDOUT)
    return done.returncode == 0, log.read_text(errors="replace")


def guilty(log, places):
    """The mutants that cause the compiler's errors. For each error: the mutants in its line, or in the
    nearest line with mutants at most six lines above. Without such a line, the lines of the error's notes
    count."""
    def mutants_at(path, line):
        where = places.get(os.path.normpath(path), {})
        near = [number for number in where if int(line) - 6 <= number <= int(line)]
        return where[max(near)] if near else set()

    numbers = set()
    for error in re.split(r"^(?=\S+?:\d+:\d+: (?:fatal )?error)", log, flags=re.MULTILINE)[1:]:
        lines = re.findall(r"^(\S+?):(\d+):\d+: ", error, re.MULTILINE)
        numbers |= next((mutants for mutants in (mutants_at(*line) for line in lines) if mutants), set())
    return numbers


def build(work, mutants, options):
    """Builds the copy without the mutants that do not compile."""
    places = lay_out(work, mutants)
    while True:
        done, log = compile_all(work, options)
        if done:
            return
        wrong = guilty(log, places)
        if not wrong:
            raise SystemExit(f"the build failed, not because of a mutant: see {work.folder / 'build.log'}")
        say(f"mutants that do not compile are left out: {sorted(wrong)}")
        for mutant in mutants:
            if mutant["number"] in wrong:
                mutant["dropped"] = True
        places = lay_out(work, mutants, keep_times=True)
        work.mutants_file.write_text(json.dumps(mutants, indent=1, ensure_ascii=False))


# ---- running tests

def refresh(work, names):
    """Copies test files again, and drops the records of the tests in these files."""
    copy(ROOT, work.tree, names)
    titles = tuple(title for name in names
                   for title in re.findall(r'TEST_CASE\(\s*"((?:[^"\\]|\\.)*)"', (ROOT / name).read_text()))
    kept = [row for row in work.lines("tests.jsonl") if not row["test"].startswith(titles)]
    lines = (json.dumps(row, ensure_ascii=False) + "\n" for row in kept)
    (work.folder / "tests.jsonl").write_text("".join(lines))


def tests_of(work, options):
    listed = subprocess.run(["ctest", "--test-dir", work.build, "--show-only=json-v1"], check=True,
                            capture_output=True).stdout
    tests = {}
    for test in json.loads(listed)["tests"]:
        if "command" in test and not re.search(options.without or NOT_RUN, test["name"]):
            place = [entry["value"] for entry in test["properties"] if entry["name"] == "WORKING_DIRECTORY"]
            tests[test["name"]] = (test["command"], place[0] if place else str(work.build))
    return tests


def limits():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))
    resource.setrlimit(resource.RLIMIT_AS, (16 << 30, 16 << 30))


def run_test(test, seconds, **more):
    """Returns (outcome, seconds, end of the output); the outcome is passed, failed, crashed or timeout."""
    command, place = test
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="mutant-", ignore_cleanup_errors=True) as scratch, \
            tempfile.TemporaryFile() as output:
        environment = {**os.environ, "TMPDIR": scratch, "OPENBLAS_CORETYPE": "SKYLAKEX", **more}
        process = subprocess.Popen(
            command, cwd=place, env=environment, stdin=subprocess.DEVNULL, stdout=output, stderr=output,
            start_new_session=True, preexec_fn=limits)
        try:
            code = process.wait(seconds)
            outcome = "passed" if code == 0 else "failed" if code > 0 else "crashed"
        except subprocess.TimeoutExpired:
            outcome = "timeout"
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.wait()
        output.seek(max(0, output.seek(0, 2) - 1500))
        return outcome, time.monotonic() - start, output.read().decode(errors="replace")


def measure(work, tests, options):
    """Runs every test on the unchanged program. Returns {name of a test that passes: its row}, with the
    duration ("seconds") and the numbers of the mutants that the test evaluates ("reached")."""
    known = {row["test"]: row for row in work.lines("tests.jsonl")}

    def measure_test(name):
        with tempfile.NamedTemporaryFile() as file:
            outcome, seconds, output = run_test(tests[name], 900, BENDLAB_MUTANTS_REACHED=file.name)
            reached = [number for number, byte in enumerate(Path(file.name).read_bytes()) if byte]
        row = {"test": name, "outcome": outcome, "seconds": round(seconds, 3), "reached": reached,
               "at": time.time()}
        if outcome != "passed":
            row["output"] = output
            say(f"this test fails without a mutant, and is not used: {name}")
        known[name] = row
        work.add_line("tests.jsonl", row)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(measure_test, [name for name in tests if name not in known]))
    return {name: known[name] for name in tests if known[name]["outcome"] == "passed"}


def judge(mutant, tests, measured, before, options):
    """Runs the tests that evaluate the mutant, quick tests first, until a test notices the mutant."""
    number = mutant["number"]
    able = sorted(
        (row for row in measured.values() if number in row["reached"]),
        key=lambda row: row["seconds"])
    slow = [row["test"] for row in able if row["seconds"] > options.slow]
    row = {"number": number, "reached_by": len(able), "left_out": slow, "at": time.time()}
    # Unchanged tests that the mutant has survived before.
    known = {test["test"] for test in able if test["at"] <
        before.get("at", 0)} & set(before.get("passed", []))
    start = time.monotonic()
    for test in able:
        if test["test"] in slow or test["test"] in known:
            continue
        name, limit = test["test"], 15 + 10 * test["seconds"]
        outcome, _, output = run_test(tests[name], limit, BENDLAB_MUTANT=str(number))
        if outcome == "timeout":  # the machine may have been paused
            outcome, _, output = run_test(tests[name], limit, BENDLAB_MUTANT=str(number))
        # If the test also fails without the mutant (on a loaded machine), it has not noticed the mutant.
        if outcome != "passed" and run_test(tests[name], 5 * limit, BENDLAB_MUTANT="0")[0] == "passed":
            row |= {"killed_by": name, "how": outcome, "output": output[-400:]}
            break
    else:
        row["passed"] = [test["test"] for test in able if test["test"] not in slow]
    row["seconds"] = round(time.monotonic() - start, 1)
    row["verdict"] = "killed" if "killed_by" in row else "survived" if able else "not reached"
    return row


def run_all(work, mutants, options):
    tests = tests_of(work, options)
    say(f"{len(tests)} tests")
    measured = measure(work, tests, options)
    results = latest(work)
    done = {result["number"] for result in results.values()
            if not (options.again and result["verdict"] != "killed")}
    left = [mutant for mutant in mutants if not mutant.get("dropped") and mutant["number"] not in done
            and (not options.numbers or mutant["number"] in options.numbers)]

    def judge_and_record(mutant):
        row = judge(mutant, tests, measured, results.get(mutant["number"], {}), options)
        work.add_line("results.jsonl", row)
        say(f"{row['verdict']:11} {describe(mutant)}   {row['seconds']} s   {row.get('killed_by', '')}")

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(judge_and_record, left))


# ---- reporting

def describe(mutant):
    return f"{mutant['number']:4} {mutant['file']}:{mutant['line']} {mutant['operator']}: {mutant['what']}"


def latest(work):
    return {row["number"]: row for row in work.lines("results.jsonl")}


def report(work, mutants):
    results, rows = latest(work), {}
    for mutant in mutants:
        if mutant.get("dropped") or mutant["number"] not in results:
            continue
        row = rows.setdefault(mutant["room"], [0, 0])
        row[0] += 1
        row[1] += results[mutant["number"]]["verdict"] == "killed"
    print("| room | mutants | killed |\n|---|---|---|")
    for room, (count, killed) in rows.items():
        print(f"| `{room}` | {count} | {killed} |")
    count, killed = (sum(row[at] for row in rows.values()) for at in (0, 1))
    print(f"| all | {count} | {killed} ({100 * killed / max(1, count):.1f} %) |\n")
    for mutant in mutants:
        result = results.get(mutant["number"])
        if result and not mutant.get("dropped") and result["verdict"] != "killed":
            more = f" ({len(result['left_out'])} slow tests left out)" if result["left_out"] else ""
            print(f"* {result['verdict']}, {result['reached_by']} tests evaluate it{more}: "
                  f"{describe(mutant).strip()}")


def parsed(arguments):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--seed", type=int, default=1, help="seed of the choice of mutants (default %(default)s)")
    add("--count", type=int, default=160, help="mutants to choose (default %(default)s)")
    add("--only", action="append", help="take all mutants from this file (name or path); may be repeated")
    add("--list", action="store_true", help="print the mutants; do not build or run them")
    add("--report", action="store_true", help="print the results so far")
    add("--again", action="store_true", help="run the survivors again, after tests were added")
    add("--numbers", type=lambda text: [int(number) for number in text.split(",")],
        help="run only the mutants with these numbers, as 3,17")
    add("--refresh", nargs="+", metavar="FILE", help="copy these test files again before building")
    add("--slow", type=float, default=20, help="leave out tests longer than this, in s (default %(default)s)")
    add("--without", help="leave out the tests that this regular expression finds, not the default list")
    add("--jobs", type=int, default=2, help="tests that run at the same time (default %(default)s)")
    add("--build-jobs", type=int, default=2, help="compilers that run at the same time (default %(default)s)")
    add("--work", default=str(ROOT / "build" / "mutants"), help="folder of all files (default %(default)s)")
    add("--tree", help="an existing copy of the sources (default: made in the folder)")
    add("--build", help="the build folder of this copy (default: made in the folder)")
    add("--no-build", action="store_true", help="do not build: the build is up to date")
    return parser.parse_args(arguments)


def main(arguments):
    options = parsed(arguments)
    work = Work(options)
    if options.report:
        report(work, json.loads(work.mutants_file.read_text()))
        return
    if not work.tree.exists():
        copy(ROOT, work.tree)
    configure(work, options)
    if not work.mutants_file.exists():
        mutants = choose(work, options)
        work.mutants_file.write_text(json.dumps(mutants, indent=1, ensure_ascii=False))
    mutants = json.loads(work.mutants_file.read_text())
    if options.list:
        print("\n".join(map(describe, mutants)))
        return
    if options.refresh:
        refresh(work, options.refresh)
    if not options.no_build:
        build(work, mutants, options)
    run_all(work, mutants, options)
    report(work, mutants)


if __name__ == "__main__":
    main(sys.argv[1:])
