#!/usr/bin/env python3
"""Runs the fuzzers one after another and prints their findings.

    tests/fuzz/run.py                        all three fuzzers, a minute each
    tests/fuzz/run.py mesh --seconds 3600    a single fuzzer, for an hour
    tests/fuzz/run.py mesh --input FILE      a single input again, as printed for a finding

Each fuzzer starts with the seeds in tests/fuzz/corpus, and with the inputs that earlier calls on this machine
kept in build/fuzz/corpus. The last line counts fuzzers: a fuzzer fails if it has a finding. The exit code is
1 if a fuzzer failed.
"""
import argparse
import base64
import os
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parents[2]
here = pathlib.Path(__file__).resolve().parent
names = ["config", "mesh", "run_file"]

# If an input takes more seconds or MB than this, it is a finding. All inputs are small, so this means an
# endless loop. On a busy machine with sanitizers, an input that usually takes 0.3 s may take 20 s.
slowest, most_memory = 90, 4000
largest = {"config": 4096, "mesh": 8192, "run_file": 4096}  # bytes


def build():
    configure = ["cmake", "--preset", "fuzz"]
    compile_all = ["cmake", "--build", "--preset", "fuzz", "--parallel", str(os.cpu_count())]
    for step in [compile_all] if (root / "build/fuzz/build.ninja").exists() else [configure, compile_all]:
        done = subprocess.run(step, cwd=root, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode:
            raise SystemExit(f"{done.stdout}failed: {' '.join(step)}")


def environment():
    # Large allocations that fail throw an exception, as without a sanitizer. Leaks in third-party libraries
    # are no findings.
    return dict(os.environ, OPENBLAS_NUM_THREADS="1",
                ASAN_OPTIONS="allocator_may_return_null=1:detect_stack_use_after_return=0",
                UBSAN_OPTIONS="print_stacktrace=1")


def last_number(pattern, text):
    numbers = re.findall(pattern, text)
    return int(numbers[-1]) if numbers else 0


def fuzz(name, programs, seconds, findings):
    """Runs a fuzzer. Returns the files of its findings."""
    kept = root / "build/fuzz/corpus" / name
    kept.mkdir(parents=True, exist_ok=True)
    findings.mkdir(parents=True, exist_ok=True)
    before = set(findings.iterdir())
    command = [programs / f"{name}_fuzzer", kept, here / "corpus" / name, f"-max_total_time={seconds}",
               f"-timeout={slowest}", f"-rss_limit_mb={most_memory}", f"-malloc_limit_mb={most_memory}",
               f"-max_len={largest[name]}", f"-artifact_prefix={findings}/{name}-", "-print_final_stats=1"]
    run = subprocess.run(
        command, cwd=findings, env=environment(),
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, errors="replace")
    text = run.stdout
    executions = last_number(r"stat::number_of_executed_units: *(\d+)", text)
    rate = last_number(r"stat::average_exec_per_sec: *(\d+)", text)
    coverage, features = last_number(r" cov: (\d+)", text), last_number(r" ft: (\d+)", text)
    print(
        f"{name:9} {executions:9} executions, {rate:6} per second, coverage {coverage} edges, {features} "
        "features", flush=True)
    if run.returncode == 0:
        return []
    (findings / f"{name}.log").write_text(text)
    new = sorted(file for file in set(findings.iterdir()) - before if file.name.startswith(f"{name}-"))
    causes = re.findall(
        r"(?:SUMMARY|BROKEN|ERROR): .*|.*runtime error: .*|terminate called.*|what\(\): .*", text)
    print(f"{name:9} FINDING: {causes[0] if causes else text[-2000:]}")
    for line in [*causes[1:5], *re.findall(r"#\d+ 0x.* in bendlab.*", text)[:8]]:
        print(f"          {line.strip()}")
    print(f"          full output: {findings / f'{name}.log'}")
    for file in new:  # with its bytes, because machines of the CI keep no files
        print(f"          repeat: {pathlib.Path(sys.argv[0])} {name} --input {file}")
        print(f"          bytes: {base64.b64encode(file.read_bytes()).decode()}")
    return new or [None]


def repeat(name, programs, file):
    return subprocess.run(
        [programs / f"{name}_fuzzer", file, f"-timeout={slowest}"],
        env=environment()).returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("fuzzers", nargs="*", help=f"any of {', '.join(names)}; default: all")
    parser.add_argument("--seconds", type=int, default=60, help="for each fuzzer (default 60)")
    parser.add_argument("--input", type=pathlib.Path, help="run a single fuzzer on this file only")
    parser.add_argument("--programs", type=pathlib.Path, help="folder of built fuzzers (default: build them)")
    arguments = parser.parse_args()
    chosen = arguments.fuzzers or names
    for name in chosen:
        if name not in names:
            parser.error(f"'{name}' is not a fuzzer; the fuzzers are {', '.join(names)}")
    if arguments.input and len(chosen) != 1:
        parser.error("--input needs exactly one fuzzer, the one that reads the file")
    if not arguments.programs:
        build()
    programs = (arguments.programs or root / "build/fuzz/bin").resolve()
    if arguments.input:
        return repeat(chosen[0], programs, arguments.input.resolve())
    findings = root / "build/fuzz/findings"
    stopped = [name for name in chosen if fuzz(name, programs, arguments.seconds, findings)]
    print(f"{len(chosen) - len(stopped)} passed, {len(stopped)} failed")
    return 1 if stopped else 0


if __name__ == "__main__":
    sys.exit(main())
