"""Computes a sweep with a real Slurm on this machine, while workers are killed, tasks are requeued, the node
goes down and time limits strike. Every run must be computed once, with the same bits as by `bendlab run`.

    slurm.py PROGRAM [--time-limit]     --time-limit adds time limits that strike inside a run, which then
                                        continues from its checkpoint; this takes some minutes more

Needs Debian's slurm-wlm and munge, and root. Starts its own munged, slurmctld and slurmd on the loopback
device, with all files in a temporary folder, and ends them by their process numbers. The exit code is 77 if
something is missing.
"""
import json
import os
import random
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from program import differences, run, run_files, times_gone_on, write_config

NEEDED = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol")
SKIPPED = 77
CPUS = 4
RUNS = 48
SWEEP = {"mesh": {"cells": 24}, "duration": 2.0,
         "sweep": {"/bending/flexural_rigidity": [1e-6 * (i + 1) for i in range(RUNS)]}}
LONG = {"mesh": {"cells": 64}, "duration": 60.0, "solver": {"substeps": 10},
        "output": {"frames_per_second": 1}}
LONG_S = 100  # CPU time, s: more than Slurm's smallest limit of a minute


def free_port():
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        return sock.getsockname()[1]


class Slurm:
    """A context in which Slurm runs, with one node of CPUS cores."""

    def __init__(self, folder):
        self.folder, self.children = folder, []
        self.node = socket.gethostname().split(".")[0]
        self.environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}

    def __enter__(self):
        try:
            self.start()
        except Exception:
            self.__exit__()
            raise
        return self

    def start(self):
        key, sockets = self.folder / "munge.key", self.folder / "munge.sock"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        self.folder.chmod(0o755)
        self.spawn("munged", "--foreground", "--force", f"--socket={sockets}", f"--key-file={key}",
                   f"--pid-file={self.folder}/munged.pid", f"--log-file={self.folder}/munged.log",
                   f"--seed-file={self.folder}/munge.seed")
        self.wait(sockets.exists, "munged creates no socket")
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        (self.folder / "slurm.conf").write_text(f"""
ClusterName=bendlab
SlurmctldHost={self.node}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={sockets},cred_expire=5
CredType=cred/munge
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,batch_sched_delay=1,defer
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=5
BatchStartTimeout=10
MpiDefault=none
NodeName={self.node} NodeAddr=127.0.0.1 CPUs={CPUS} State=UNKNOWN
PartitionName=all Nodes={self.node} Default=YES MaxTime=INFINITE State=UP
""")
        self.spawn("slurmctld", "-D")
        self.spawn("slurmd", "-D", "-N", self.node)
        self.wait(lambda: self.ask("sinfo", "--noheader", "--format=%t").strip() in ("idle", "mix"),
                  "the node does not come up")

    def spawn(self, *command):
        log = open(self.folder / f"{command[0]}.out", "wb")
        self.children.append(subprocess.Popen([f"/usr/sbin/{command[0]}", *command[1:]], stdout=log,
                                              stderr=log, env=self.environment))

    def wait(self, condition, complaint, limit=30):
        end = time.monotonic() + limit
        while not condition():
            if time.monotonic() > end:
                texts = [f"{log.name}: {log.read_text(errors='replace')[-500:]}"
                         for log in sorted(self.folder.glob("*.log"))]
                raise SystemExit("\n".join([complaint, *texts]))
            time.sleep(0.2)

    def ask(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True).stdout

    def tasks(self):
        """{task: state} of the array."""
        lines = self.ask("squeue", "--noheader", "--array", "--format=%i %T").split("\n")
        return dict(line.split() for line in lines if line)

    def running(self):
        return sorted(task for task, state in self.tasks().items() if state == "RUNNING")

    def __exit__(self, *_):
        for child in reversed(self.children):
            child.send_signal(signal.SIGTERM)
        for child in self.children:
            try:
                child.wait(10)
            except subprocess.TimeoutExpired:
                child.kill()


def workers(plan):
    """Process numbers of the workers of a plan."""
    numbers = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                words = (entry / "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if len(words) > 2 and words[1] == b"work" and words[2] == str(plan).encode():
                numbers.append(int(entry.name))
    return numbers


def states(program, folder, plan):
    answer = run(program, "status", plan, "--json", folder=folder)
    count = {answer.stderr: 1} if answer.returncode else {}
    for line in answer.stdout.splitlines():
        entry = json.loads(line)
        state = " ".join(filter(None, (entry["state"], entry["text"])))
        count[state] = count.get(state, 0) + 1
    return count


def disturb(slurm, plan, what, chance):
    """Disturbs the sweep once. True if there was something to disturb."""
    if what == "kill":
        if victims := workers(plan):
            os.kill(chance.choice(victims), signal.SIGKILL)
            return True
    elif what == "requeue":
        if tasks := slurm.running():
            slurm.ask("scontrol", "requeue", chance.choice(tasks))
            return True
    elif what == "node" and slurm.running():
        slurm.ask("scontrol", "update", f"nodename={slurm.node}", "state=down", "reason=test")
        slurm.wait(lambda: not slurm.running(), "the tasks of the node continue while it is down")
        slurm.ask("scontrol", "update", f"nodename={slurm.node}", "state=resume")
        return True
    return False


def computed_by_workers(plan):
    """{run: how often workers report that they computed it}"""
    count = {}
    for log in Path(str(plan)[:-5] + ".logs").glob("*.log"):
        for name in re.findall(r"^(?:bendlab: )?(.*): complete in ", log.read_text(), re.M):
            count[name] = count.get(name, 0) + 1
    return count


def long_run(program, folder):
    """LONG with a duration that takes about LONG_S on this machine, by a run of one second of it."""
    write_config(folder, "probe", **{**LONG, "duration": 1})
    took = json.loads(run(program, "run", "probe.json", "--json", folder=folder).stdout)["cpu_s"]
    return {**LONG, "duration": round(LONG_S / took, 1)}


def sweep(program, folder, slurm, name, settings, disturbances, *options):
    """Submits a sweep and disturbs it. Returns the problems and the disturbances."""
    write_config(folder, name, **settings)
    submit = lambda: run(program, "submit", f"{name}.json", "--out", "cluster", "--tasks", "6", *options,
                         folder=folder, env=slurm.environment)
    answer = submit()
    print((answer.stdout + answer.stderr).strip(), flush=True)
    if answer.returncode:
        return [f"{name}: submit ended with {answer.returncode}"]
    plan = next((folder / "cluster" / "plans").glob(f"{name}-*.plan.json"))
    chance, done, restarts = random.Random(1), [], 0
    for what in disturbances:
        slurm.wait(lambda: workers(plan) or not slurm.tasks(), "no worker begins", 60)
        time.sleep(chance.uniform(0.5, 2))
        if disturb(slurm, plan, what, chance):
            done.append(what)
    for _ in range(3):  # Slurm does not repeat killed tasks; submitting again computes the remaining runs
        slurm.wait(lambda: not slurm.tasks(), "the tasks do not end", 600)
        if set(states(program, folder, plan)) <= {"complete"}:
            break
        restarts += 1
        submit()
    final = states(program, folder, plan)
    wrong = [] if set(final) == {"complete"} else [f"{name}: states at the end: {final}"]
    repeated = {computed: times for computed, times in computed_by_workers(plan).items() if times != 1}
    wrong += [f"{name}: {computed} was computed {times} times" for computed, times in repeated.items()]
    run(program, "run", f"{name}.json", "--out", "alone", folder=folder)
    for file in run_files(folder / "alone" / name):
        other = folder / "cluster" / file.relative_to(folder / "alone")
        wrong += [f"{name}: {file.parent.name}: {what}" for what in differences(file, other)]
    went_on = sum(map(times_gone_on, run_files(folder / "cluster" / name)))
    if "--time" in options and not went_on:
        wrong.append(f"{name}: no time limit struck inside a run, so no run continued")
    requeues = sum(log.read_text().count("bendlab: stopped") for log in plan.parent.glob("**/*.log"))
    print(f"{name}: {final}, disturbed by {done}, submitted again {restarts} times, stopped by signals in "
          f"{requeues} tasks, went on {went_on} times, {len(wrong)} wrong", flush=True)
    return wrong


def main(program, *options):
    missing = [name for name in NEEDED if not shutil.which(name, path="/usr/sbin:/usr/bin:/sbin:/bin")]
    if missing or os.geteuid() != 0:
        print("skipped:", f"{', '.join(missing)} not found; apt-get install slurm-wlm munge" if missing
              else "only root can start slurmd")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "slurm").mkdir()
        with Slurm(folder / "slurm") as slurm:
            wrong = sweep(program, folder, slurm, "short", SWEEP, ["kill", "requeue", "node", "kill", "kill"])
            if "--time-limit" in options:
                wrong += sweep(program, folder, slurm, "long", long_run(program, folder), [], "--time", "1",
                               "--sbatch=--signal=B:TERM@20")
    print("\n".join(wrong) if wrong else "every run was computed once, with the same bits")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
