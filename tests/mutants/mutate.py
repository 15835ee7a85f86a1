"""Does the test suite catch mistakes? Makes small ones (mutants), one at a time, and runs the tests on each.

    mutate.py [--seed 1] [--count 160] [--only FILE] [--list] [--report] …      README.md here explains

All mutants are built at once, into one program that asks an environment variable which of them is switched
on. A first run of every test notes which mutants it evaluates, so that a mutant is met by those tests only.
Stopped at any moment, the same command goes on there.
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

# Mutants out of a hundred that each room gets.
ROOMS = {"lib/bendlab/constraints": 12, "lib/bendlab/bending": 12, "lib/bendlab/effects": 12,
         "lib/bendlab/solver": 13, "lib/bendlab/mesh": 8, "lib/bendlab/metrics": 7, "lib/bendlab/io": 5,
         "experiments/measures": 10, "experiments/config": 9, "experiments/run": 7, "lib/bendlab/scene": 3,
         "experiments/campaign": 2}
# How often an operator is taken where a line offers several.
WEIGHTS = {"early return": 0.3, "removal": 0.8, "boundary": 0.6}
# Tests that never run the program, or only measure its speed, or kill it; and those built once more.
NOT_RUN = (r"^(generic x86-64:.*|install|trust_kills|trust_workers|performance|analysis|claim_map|where|"
           r"map_rules|stated_numbers)$")


def say(*words):
    print(*words, file=sys.stderr, flush=True)


class Work:
    """The folder that everything is in: the copy of the sources, its build, what was found so far."""

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
    """The files that git knows or would add. A file that is the same keeps its time, so nothing is built
    again."""
    if names is None:
        listed = subprocess.run(
            ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
            cwd=root, check=True, capture_output=True).stdout
        names = [each.decode() for each in listed.split(b"\0") if each]
    for name in names:
        source, target = root / name, tree / name
        if source.is_file() and not (target.exists() and target.read_bytes() == source.read_bytes()):
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, target)


# ---- choosing

def sources(tree, room, only):
    found = sorted(file for file in (tree / room).rglob("*.[ch]pp") if file.is_file())
    if only:
        found = [file for file in found if str(file.relative_to(tree)) in only or file.name in only]
    return found


def code_lines(file):
    """The numbers of the lines that are neither empty, nor a comment, nor an include."""
    return [number for number, line in enumerate(file.read_text().splitlines(), 1)
            if not re.match(r"\s*(//.*|#.*|[{}();]*|namespace .*|}.*// namespace.*)?$", line)]


def compile_flags(work, file):
    """What libclang needs of the flags of the file, or of another one of its folder (a header, a unity
    build)."""
    commands = [each for each in json.loads((work.build / "compile_commands.json").read_text())
                if "generic" not in each["command"]]
    own = [each for each in commands if each["file"] == str(file)]
    room = str(file.relative_to(work.tree)).split("/")[:2]
    beside = [each for each in commands if "/".join(room) in each["file"]
              or (room[0] == "experiments" and "bendlab_experiments.dir" in each["command"])]
    words = shlex.split((own or beside)[0]["command"])
    flags, system = [], []
    for at, word in enumerate(words):
        if word.startswith(("-I", "-D", "-std=", "-march=")):
            flags.append(word)
        elif word == "-isystem":
            system += [word, words[at + 1]]
    # Headers of a room see what its sources see.
    for each in beside if file.suffix == ".hpp" else []:
        other = shlex.split(each["command"])
        system += [w for at, word in enumerate(other) if word == "-isystem" for w in (word, other[at + 1])]
    return flags + system + ["-x", "c++", "-w"]


def candidates(work, file):
    """All changes that the file offers; found once, as libclang takes seconds."""
    from sites import Finder
    finder = HERE / "sites.py"
    key = hashlib.sha256(file.read_bytes() + finder.read_bytes()).hexdigest()[:16]
    kept = work.folder / "sites" / f"{file.name}.{key}.json"
    if not kept.exists():
        kept.parent.mkdir(exist_ok=True)
        kept.write_text(json.dumps(Finder(file, compile_flags(work, file)).found, ensure_ascii=False))
    return json.loads(kept.read_text())


def overlap(one, other):
    return one["file"] == other["file"] and any(
        a[0] < b[1] and b[0] < a[1] or a[0] == b[0] for a in one["edits"] for b in other["edits"])


def draw(chance, lines, found):
    """A line of code by chance, then one of the changes that begin there."""
    file, number = chance.choice(lines)
    there = [each for each in found(file) if each["line"] == number]
    if not there:
        return None
    kinds = sorted({each["operator"] for each in there})
    kind = chance.choices(kinds, [WEIGHTS.get(each, 1) for each in kinds])[0]
    return file, chance.choice([each for each in there if each["operator"] == kind])


def choose(work, options):
    chance = random.Random(options.seed)
    chosen = []
    found = lambda file: candidates(work, file)  # noqa: E731
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
            drawn = draw(chance, lines, found)
            if drawn is None:
                continue
            mutant = {"room": room, "file": str(drawn[0].relative_to(work.tree)), **drawn[1]}
            if not any(overlap(mutant, each) for each in mine):
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
    """The file's bytes with all these mutants in it, and for each of its lines the numbers of its mutants."""
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
    """Writes the changed sources into the copy. Gives {file: {line: numbers}}. Where mutants were only taken
    out, objects that did compile are still right: with the file's time kept they are not built again."""
    shutil.copy2(HERE / "mutant.hpp", work.folder / "mutant.hpp")
    header = work.folder / "mutant.hpp"
    places = {}
    for name in sorted({each["file"] for each in mutants}):
        target, kept = work.tree / name, work.folder / "originals" / name
        if not kept.exists():
            kept.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(target, kept)
        mine = [each for each in mutants if each["file"] == name and not each.get("dropped")]
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
                               "bendlab_program", "bendlab_tests"], stdout=file, stderr=subprocess.STDOUT)
    return done.returncode == 0, log.read_text(errors="replace")


def guilty(log, places):
    """The mutants on the lines of the compiler's errors, or nearest above them; else of the notes to an
    error."""
    def mutants_at(path, line):
        where = places.get(os.path.normpath(path), {})
        near = [each for each in where if int(line) - 6 <= each <= int(line)]
        return where[max(near)] if near else set()

    numbers = set()
    for error in re.split(r"^(?=\S+?:\d+:\d+: (?:fatal )?error)", log, flags=re.MULTILINE)[1:]:
        lines = re.findall(r"^(\S+?):(\d+):\d+: ", error, re.MULTILINE)
        numbers |= next((found for found in (mutants_at(*each) for each in lines) if found), set())
    return numbers


def build(work, mutants, options):
    """Builds, without the mutants that do not compile."""
    places = lay_out(work, mutants)
    while True:
        done, log = compile_all(work, options)
        if done:
            return
        wrong = guilty(log, places)
        if not wrong:
            raise SystemExit(f"the build failed, and not at a mutant: see {work.folder / 'build.log'}")
        say(f"do not compile, left out: {sorted(wrong)}")
        for mutant in mutants:
            if mutant["number"] in wrong:
                mutant["dropped"] = True
        places = lay_out(work, mutants, keep_times=True)
        work.mutants_file.write_text(json.dumps(mutants, indent=1, ensure_ascii=False))


# ---- running tests

def refresh(work, names):
    """Copies test files anew, and forgets what is known of the tests in them."""
    copy(ROOT, work.tree, names)
    titles = tuple(title for name in names
                   for title in re.findall(r'TEST_CASE\(\s*"((?:[^"\\]|\\.)*)"', (ROOT / name).read_text()))
    kept = [row for row in work.lines("tests.jsonl") if not row["test"].startswith(titles)]
    lines = (json.dumps(row, ensure_ascii=False) + "\n" for row in kept)
    (work.folder / "tests.jsonl").write_text("".join(lines))


def tests_of(work, options):
    shown = subprocess.run(["ctest", "--test-dir", work.build, "--show-only=json-v1"], check=True,
                           capture_output=True).stdout
    tests = {}
    for each in json.loads(shown)["tests"]:
        if "command" in each and not re.search(options.without or NOT_RUN, each["name"]):
            place = [one["value"] for one in each["properties"] if one["name"] == "WORKING_DIRECTORY"]
            tests[each["name"]] = (each["command"], place[0] if place else str(work.build))
    return tests


def limits():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))
    resource.setrlimit(resource.RLIMIT_AS, (16 << 30, 16 << 30))


def run_test(test, seconds, **more):
    """(outcome, seconds, last lines of output); the outcome is passed, failed, crashed or timeout."""
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
    """Runs every test on the unchanged program. {name: (seconds, numbers of the mutants it evaluates)}"""
    known = {each["test"]: each for each in work.lines("tests.jsonl")}

    def one(name):
        with tempfile.NamedTemporaryFile() as notes:
            outcome, seconds, output = run_test(tests[name], 900, BENDLAB_MUTANTS_REACHED=notes.name)
            reached = [number for number, byte in enumerate(Path(notes.name).read_bytes()) if byte]
        row = {"test": name, "outcome": outcome, "seconds": round(seconds, 3), "reached": reached,
               "at": time.time()}
        if outcome != "passed":
            row["output"] = output
            say(f"fails without a mutant, not used: {name}")
        known[name] = row
        work.add_line("tests.jsonl", row)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(one, [name for name in tests if name not in known]))
    return {name: known[name] for name in tests if known[name]["outcome"] == "passed"}


def judge(mutant, tests, measured, before, options):
    """Runs the tests that evaluate the mutant, quick ones first, up to the first that notices it."""
    number = mutant["number"]
    able = sorted(
        (row for row in measured.values() if number in row["reached"]),
        key=lambda row: row["seconds"])
    slow = [row["test"] for row in able if row["seconds"] > options.slow]
    row = {"number": number, "reached_by": len(able), "left_out": slow, "at": time.time()}
    # Tests that it has survived before, and that are as they were.
    known = {each["test"] for each in able if each["at"] <
        before.get("at", 0)} & set(before.get("passed", []))
    start = time.monotonic()
    for each in able:
        if each["test"] in slow or each["test"] in known:
            continue
        name, limit = each["test"], 15 + 10 * each["seconds"]
        outcome, _, output = run_test(tests[name], limit, BENDLAB_MUTANT=str(number))
        if outcome == "timeout":  # or was the machine paused?
            outcome, _, output = run_test(tests[name], limit, BENDLAB_MUTANT=str(number))
        # A test that fails by itself, on a loaded machine, notices nothing.
        if outcome != "passed" and run_test(tests[name], 5 * limit, BENDLAB_MUTANT="0")[0] == "passed":
            row |= {"killed_by": name, "how": outcome, "output": output[-400:]}
            break
    else:
        row["passed"] = [each["test"] for each in able if each["test"] not in slow]
    row["seconds"] = round(time.monotonic() - start, 1)
    row["verdict"] = "killed" if "killed_by" in row else "survived" if able else "not reached"
    return row


def run_all(work, mutants, options):
    tests = tests_of(work, options)
    say(f"{len(tests)} tests")
    measured = measure(work, tests, options)
    results = latest(work)
    done = {each["number"] for each in results.values()
            if not (options.again and each["verdict"] != "killed")}
    left = [each for each in mutants if not each.get("dropped") and each["number"] not in done
            and (not options.numbers or each["number"] in options.numbers)]

    def one(mutant):
        row = judge(mutant, tests, measured, results.get(mutant["number"], {}), options)
        work.add_line("results.jsonl", row)
        say(f"{row['verdict']:11} {describe(mutant)}   {row['seconds']} s   {row.get('killed_by', '')}")

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(one, left))


# ---- telling

def describe(mutant):
    return f"{mutant['number']:4} {mutant['file']}:{mutant['line']} {mutant['operator']}: {mutant['what']}"


def latest(work):
    return {each["number"]: each for each in work.lines("results.jsonl")}


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
    count, killed = (sum(each[at] for each in rows.values()) for at in (0, 1))
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
    add("--seed", type=int, default=1, help="of the choice of mutants (default %(default)s)")
    add("--count", type=int, default=160, help="mutants to choose (default %(default)s)")
    add("--only", action="append", help="a source file, by name or path: all mutants in it; may be repeated")
    add("--list", action="store_true", help="print the mutants, and neither build nor run")
    add("--report", action="store_true", help="print what was found so far")
    add("--again", action="store_true", help="run the survivors once more: after tests were added")
    add("--numbers", type=lambda text: [int(each) for each in text.split(",")],
        help="run these mutants only: 3,17")
    add("--refresh", nargs="+", metavar="FILE", help="copy these files (tests) anew before building")
    add("--slow", type=float, default=20, help="leave out tests longer than this, in s (default %(default)s)")
    add("--without", help="leave out the tests that this regular expression finds, instead of the usual ones")
    add("--jobs", type=int, default=2, help="tests at once (default %(default)s)")
    add("--build-jobs", type=int, default=2, help="compilers at once (default %(default)s)")
    add("--work", default=str(ROOT / "build" / "mutants"), help="folder for everything (default %(default)s)")
    add("--tree", help="an existing copy of the sources (default: made in the folder)")
    add("--build", help="its build folder (default: made in the folder)")
    add("--no-build", action="store_true", help="the build is up to date")
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
