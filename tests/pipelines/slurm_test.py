"""A batch on Slurm: with daemons of its own, on the loopback address, that run as long as the test.

A task is requeued while it works, another is killed; what they hadn't built by then is built all the same, by the requeued
task or by the batch when it is run again.
"""
import json
import os
import pathlib
import pwd
import shutil
import signal
import socket
import subprocess
import time

from pipeline_case import ASSETS, PROGRAM, QUICKEST, PipelineCase, content_of, hidden_in, main

PROGRAMS = ("slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "munged", "runuser")

# Five processors, so that all tasks run at the same time; arrays of at most four tasks. A job that is requeued waits until
# the credentials of its first run have expired: that is two minutes, if nobody shortens it.
SLURM_CONF = """
ClusterName=lozenge
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
AuthType=auth/munge
AuthInfo=socket={munge}/socket,cred_expire=6
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
PropagateResourceLimits=NONE
MpiDefault=none
ReturnToService=2
MaxArraySize=4
SchedulerParameters=batch_sched_delay=0,sched_interval=1
NodeName={host} NodeAddr=127.0.0.1 CPUs=5 State=UNKNOWN
PartitionName=day Nodes=ALL Default=NO MaxTime=INFINITE State=UP
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


class BatchesOnSlurm(PipelineCase):
    def setUp(self):
        super().setUp()
        missing = [program for program in PROGRAMS if not shutil.which(program)]
        if missing:
            self.skipTest(f"not installed: {', '.join(missing)} (Debian's slurm-wlm and munge have them)")
        if os.geteuid() != 0:
            self.skipTest("Slurm's daemons want to be started by root")
        self.daemons = []
        self.addCleanup(self.stop)
        self.start()

    def start_daemon(self, name, *words):
        with (self.folder / f"{name}.log").open("w") as log:
            self.daemons.append(subprocess.Popen(words, stdout=log, stderr=log, env=self.environment, start_new_session=True))

    def start(self):
        self.folder.chmod(0o755)
        munge = self.folder / "munge"
        munge.mkdir()
        (munge / "key").write_bytes(os.urandom(128))
        (munge / "key").chmod(0o400)
        user = pwd.getpwnam("munge")
        for path in (munge, munge / "key"):
            os.chown(path, user.pw_uid, user.pw_gid)
        host = socket.gethostname().split(".")[0]
        conf = self.folder / "slurm.conf"
        conf.write_text(SLURM_CONF.format(host=host, ports=free_ports(2), munge=munge, folder=self.folder))
        self.environment = {**os.environ, "SLURM_CONF": str(conf)}
        os.environ["SLURM_CONF"] = str(conf)
        self.addCleanup(os.environ.pop, "SLURM_CONF")
        files = [f"--{option}={munge}/{name}" for option, name in
                 (("socket", "socket"), ("key-file", "key"), ("pid-file", "pid"), ("log-file", "log"), ("seed-file", "seed"))]
        self.start_daemon("munged", "runuser", "-u", "munge", "--", "munged", "--foreground", *files)
        self.wait_for(lambda: (munge / "socket").exists(), "munged")
        self.start_daemon("slurmctld", "slurmctld", "-D", "-f", conf)
        self.start_daemon("slurmd", "slurmd", "-D", "-f", conf)
        self.wait_for(lambda: "idle" in self.ask("sinfo", "--noheader", "--format=%T"), "slurmd")

    def stop(self):
        """Ends the daemons, and the steps that are left of jobs."""
        if hasattr(self, "environment"):
            subprocess.run(["scancel", "--user=root"], env=self.environment, capture_output=True, check=False, timeout=60)
        for daemon in reversed(self.daemons):
            daemon.send_signal(signal.SIGTERM)
            try:
                daemon.wait(timeout=20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def wait_for(self, is_so, what, seconds=240):
        end = time.monotonic() + seconds
        while not is_so():
            if time.monotonic() > end:
                logs = "\n".join(f"== {log.name}\n{log.read_text()[-3000:]}" for log in self.folder.rglob("*.log") if log.is_file())
                self.fail(f"waited in vain for {what}\n{self.ask('squeue')}\n{logs}")
            time.sleep(0.1)

    def ask(self, *words):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, check=False).stdout

    def task_of(self, number):
        """The process of a task of the array, once it builds something; its number, and that of its first child."""
        mark = f"manifest-{number}.jsonl"
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                words = (process / "cmdline").read_bytes().decode().split("\0")
                children = (process / "task" / process.name / "children").read_text().split()
            except OSError:
                continue
            if len(words) > 1 and words[1] == "batch" and any(word.endswith(mark) and str(self.folder) in word for word in words) and children:
                return int(process.name)
        return None

    def test_ARequeuedTaskResumesAndAKilledOneIsMadeUpForByTheNextRun(self):
        assets, out = self.folder / "assets", self.folder / "out"
        assets.mkdir()
        # Two that take some seconds, the largest, which are alone in their tasks or the first; and small ones.
        for name in ("slow_1", "slow_2"):
            shutil.copy(ASSETS / "torus.glb", assets / f"{name}.glb")
        for number in range(4):
            shutil.copy(ASSETS / "triangle.glb", assets / f"small_{number}.glb")
        words = ["batch", assets, "-o", out, "--slurm", "--sbatch=--partition=day", "--json", *QUICKEST[2:], "--map-size", "96"]
        submitted = json.loads(self.run_program(*words).stdout)
        self.assertEqual((submitted["tasks"], submitted["assets"]), (4, 6), "as many tasks as MaxArraySize allows")

        self.wait_for(lambda: self.task_of(0) and self.task_of(1), "both slow tasks")
        requeued = self.ask("scontrol", "requeue", f"{submitted['array']}_0")
        os.kill(self.task_of(1), signal.SIGKILL)
        self.wait_for(lambda: not self.ask("squeue", "--noheader"), "all jobs to end")
        log = (out / "slurm/round-1/task-0.log").read_text()
        self.assertIn("REQUEUE", log.upper(), f"{requeued}{log}")

        rows = {row["output"]: row for row in map(json.loads, (out / "manifest.jsonl").read_text().splitlines())}
        self.assertEqual(len(rows), 6)
        lost = [output for output, row in rows.items() if row["status"] == "lost"]
        self.assertEqual(lost, ["slow_2"], "the task that was killed had come to nothing else")
        self.assertEqual(rows["slow_1"]["status"], "done", "the requeued one was built after all")
        self.assertTrue((out / "summary.html").exists())

        again = json.loads(self.run_program(*words, "--wait").stdout)
        self.assertEqual((again["tasks"], again["assets"], again["settled"]), (1, 1, 5))
        rows = [json.loads(line) for line in (out / "manifest.jsonl").read_text().splitlines()]
        self.assertEqual([row["status"] for row in rows], ["done"] * 6)
        self.assertEqual(hidden_in(out), [])
        # What the farm made is what one machine makes.
        self.build(assets / "slow_2.glb", self.folder / "alone", *QUICKEST[2:], "--map-size", "96")
        for name, content in content_of(self.folder / "alone").items():
            self.assertEqual(content, (out / name).read_bytes(), name)
        # Nothing is left to be submitted.
        self.assertEqual(json.loads(self.run_program(*words).stdout)["done"], 6)
        print("\n".join(path.read_text() for path in sorted((out / "slurm").rglob("*.log"))))


if __name__ == "__main__":
    main()
