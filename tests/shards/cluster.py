"""A Slurm cluster of one node on loopback: munged, slurmctld and slurmd, in a scratch folder, on
free ports, without systemd and without affecting the machine's own Slurm. Requires root."""

import os
import pathlib
import secrets
import shutil
import socket
import subprocess
import time

import guarded

DAEMONS = ('munged', 'slurmctld', 'slurmd')
COMMANDS = ('sbatch', 'scontrol', 'squeue', 'sinfo')

# An empty SlurmctldParameters is fatal, so options without a value are left out. A requeued task waits
# for the lifetime of a credential, two minutes by default.
CONFIGURATION = """ClusterName=touchdown
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/controller
SlurmdSpoolDir={folder}/node
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SchedulerParameters={scheduling}
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
SlurmdParameters=config_overrides
NodeName=here NodeHostname={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""

# Control groups are not used, but slurmd looks for their file system and does not start without it, as
# in a bare chroot. With a given version it does not look.
CGROUPS = 'CgroupPlugin=cgroup/v1\n'


def missing():
    """Missing requirements; empty if there are none."""
    if os.geteuid() != 0:
        return 'Slurm\'s daemons need to be started by root'
    os.environ['PATH'] += ':/usr/sbin:/sbin'
    absent = [name for name in DAEMONS + COMMANDS if not shutil.which(name)]
    return f'no {", ".join(absent)} here (Debian packages slurm-wlm and munge)' if absent else ''


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    try:
        for each in sockets:
            each.bind(('127.0.0.1', 0))
        return [each.getsockname()[1] for each in sockets]
    finally:
        for each in sockets:
            each.close()


class DoesNotStart(Exception):
    """Slurm's daemons are installed, but do not run in this environment."""


class Cluster(guarded.Guarded):
    """A context manager: the cluster runs inside `with`, and leaves nothing afterwards."""

    def __init__(self, cpus, scheduling='sched_interval=1,bf_interval=1,batch_sched_delay=0'):
        self.cpus = cpus
        self.scheduling = scheduling

    def prepare(self):
        self.environment['SLURM_CONF'] = str(self.folder / 'slurm.conf')

    def start(self):
        munge = self.folder / 'munge'
        for name in ('munge', 'controller', 'node'):
            (self.folder / name).mkdir(mode=0o755)
        (munge / 'key').write_bytes(secrets.token_bytes(128))
        (munge / 'key').chmod(0o400)
        self.daemon('munged', '--foreground', '--force', f'--key-file={munge}/key',
                    f'--socket={munge}/socket', f'--pid-file={munge}/pid',
                    f'--seed-file={munge}/seed', f'--log-file={munge}/log')
        self.wait_for('munged', lambda: (munge / 'socket').exists())
        for _ in range(3):  # another program may take a free port meanwhile
            controller_port, node_port = free_ports(2)
            (self.folder / 'slurm.conf').write_text(CONFIGURATION.format(
                folder=self.folder, cpus=self.cpus, host=socket.gethostname().split('.')[0],
                controller_port=controller_port, node_port=node_port, scheduling=self.scheduling))
            (self.folder / 'cgroup.conf').write_text(CGROUPS)
            pids = [self.daemon('slurmctld', '-D'), self.daemon('slurmd', '-D', '-N', 'here')]
            if self.wait_until_idle(pids):
                return
        raise DoesNotStart('Slurm does not start here\n' + self.logs())

    def daemon(self, name, *arguments):
        return self.process(shutil.which(name), *arguments)

    def wait_until_idle(self, pids, seconds=60.0):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if self.run('sinfo', '-h', '-o', '%T', check=False).stdout.strip() == 'idle':
                return True
            if not all(pathlib.Path(f'/proc/{pid}').exists() for pid in pids):
                return False
            time.sleep(0.05)
        return False

    def run(self, *arguments, cwd=None, check=True):
        ended = subprocess.run([str(a) for a in arguments], cwd=cwd or self.folder, text=True,
                               env=self.environment, capture_output=True)
        if check and ended.returncode != 0:
            raise RuntimeError(f'{arguments} failed: {ended.stderr}')
        return ended

    def job(self, job):
        """Fields of `scontrol show job` by name; '12_3' is one array task."""
        shown = self.run('scontrol', '-o', 'show', 'job', job, check=False).stdout
        return dict(word.split('=', 1) for word in shown.split() if '=' in word)
