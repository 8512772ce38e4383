"""Runs a small experiment by the two recipes for ssh in docs/guides/shards.md, with its own server
on loopback: every file must equal that of a single run.

    ssh_test.py TOUCHDOWN

Exit code 77: there is no ssh, no sshd or no rsync here, or sshd does not start or refuses logins.
"""

import getpass
import os
import pathlib
import shutil
import subprocess
import sys
import time

import cluster
import recipes
import work
from work import check

HOSTS = ('node1', 'node2', 'node3')
SEEDS = 20
PARTS = 2 * SEEDS  # of each shard: three runs in two engines
# Only the user who runs the test may log in, with one key, from this machine.
SERVER = """ListenAddress 127.0.0.1
Port {port}
HostKey {folder}/host_key
AuthorizedKeysFile {folder}/client_key.pub
AllowUsers {user}
PidFile {folder}/sshd.pid
PermitRootLogin prohibit-password
PasswordAuthentication no
KbdInteractiveAuthentication no
UsePAM no
StrictModes no
MaxStartups 100
AcceptEnv HOME
SetEnv PATH={path}
"""
CLIENT = """Host {hosts}
  HostName 127.0.0.1
  Port {port}
  User {user}
  IdentityFile {folder}/client_key
  IdentitiesOnly yes
  UserKnownHostsFile {folder}/known_hosts
  StrictHostKeyChecking yes
  BatchMode yes
  LogLevel ERROR
"""


class DoesNotStart(Exception):
    """The required programs are installed, but do not run in this environment."""


class Hosts(recipes.Recipes):
    """Three host names of this machine, for `ssh` without a password."""

    def start(self):
        for name in ('host_key', 'client_key'):
            subprocess.run(['ssh-keygen', '-q', '-t', 'ed25519', '-N', '', '-C', name,
                            '-f', self.folder / name], check=True)
        if os.geteuid() == 0:  # normally created by its service
            pathlib.Path('/run/sshd').mkdir(mode=0o755, exist_ok=True)
        for _ in range(3):  # another program may take a free port meanwhile
            values = {'folder': self.folder, 'port': cluster.free_ports(1)[0],
                      'user': getpass.getuser(), 'hosts': ' '.join(HOSTS),
                      'path': self.environment['PATH']}
            (self.folder / 'sshd_config').write_text(SERVER.format(**values))
            (self.folder / 'ssh_config').write_text(CLIENT.format(**values))
            key = (self.folder / 'host_key.pub').read_text()
            (self.folder / 'known_hosts').write_text(f'[127.0.0.1]:{values["port"]} {key}')
            # Each host name has its own home, like another machine. Remote commands of a recipe start
            # in it.
            self.script('ssh', self.client())
            server = self.process(shutil.which('sshd'), '-D', '-e', '-f',
                                  self.folder / 'sshd_config')
            if self.answers(server):
                return
        raise DoesNotStart('sshd does not start\n' + self.logs())

    def client(self):
        """A wrapper of `ssh` with the test's configuration, which starts in the home of the named host."""
        homes = '\n'.join(f'mkdir -p \'{self.folder}/home_{host}\'' for host in HOSTS)
        return f'''{homes}
words=("$@")
{'' if os.geteuid() == 0 else 'words=("${words[@]/#-tt/-T}") # only root may allocate a terminal'}
for ((i = 0; i < ${{#words[@]}}; i++)); do
  case "${{words[i]}}" in
    {'|'.join(HOSTS)})
      home="{self.folder}/home_${{words[i]}}"
      [[ "${{words[i + 1]}}" == -- ]] && i=$((i + 1))
      words[i + 1]="cd '$home' && ${{words[i + 1]}}"
      break
      ;;
  esac
done
exec '{shutil.which('ssh')}' -F '{self.folder}/ssh_config' "${{words[@]}}"'''

    def answers(self, server):
        """Waits until a login works; False if the server has ended."""
        end = time.monotonic() + 20.0
        while pathlib.Path(f'/proc/{server}').exists():
            output = subprocess.run([self.bin / 'ssh', HOSTS[0], 'command -v touchdown'], text=True,
                                  capture_output=True, env=self.environment, check=False)
            if output.stdout.strip() == str(self.bin / 'touchdown'):
                return True
            if time.monotonic() > end:
                raise DoesNotStart('sshd refuses logins: ' + output.stderr + self.logs())
            time.sleep(0.1)
        return False


def shared(**changes):
    values = {'experiment': 'tiny.yaml', 'out': 'out', 'hosts': '(node1 node2 node3)'}
    return work.recipe('ssh, with a shared folder', **{**values, **changes})


def stop_in_the_middle(hosts):
    """Stops the recipe as Ctrl-C does: remote shards must stop too."""
    loop = hosts.begin(shared())
    evaluation = hosts.work / 'out' / 'state' / 'evaluation'
    hosts.wait_for('some work to be done', lambda: len(list(evaluation.glob('[!.]*'))) > 3)
    recipes.interrupt(loop)
    hosts.wait_for('the shards to stop', lambda: not recipes.processes_in(hosts.work), 20)
    saved = len(list(evaluation.glob('[!.]*')))
    check(3 < saved < 3 * PARTS, f'{saved} of {3 * PARTS} parts: it was over before it could be stopped')
    print(f'stopped after {saved} parts')


def test(hosts, touchdown):
    work.write_experiment(hosts.work, runs=3, seeds=SEEDS)
    if os.geteuid() == 0:
        stop_in_the_middle(hosts)
    output = hosts.run(shared())
    for shard in (1, 2, 3):
        check(f'shard {shard}/3: {PARTS} parts' in output, output)
    work.compare_with_local_run(hosts.work / 'out', touchdown, hosts.work)

    output = hosts.run(shared(out='no', experiment='tinny.yaml'), fails=True)
    check('tinny.yaml: no such file' in output and 'evaluated before' not in output, output)

    # GNU parallel over ssh, if it is installed, with hosts in parallel.
    if shutil.which('parallel'):
        output = hosts.run(work.recipe('GNU parallel', experiment='tiny.yaml', out='parallel',
                                     shards='5', hosts='node1,node2'))
        check(output.count('computed now') == 5, output)
        work.compare_with_local_run(hosts.work / 'parallel', touchdown, hosts.work)

    # Folders that are not shared: each host has only its own.
    alone = hosts.folder / 'alone'
    alone.mkdir()
    for name in ('step.yaml', 'tiny.yaml'):
        shutil.copy(hosts.work / name, alone)
    output = hosts.run(f'cd \'{alone}\'\n' + work.recipe(
        'ssh, without a shared folder', experiment='tiny.yaml', out='out',
        hosts='(node1 node2 node3)', there='shards'))
    for shard, host in enumerate(HOSTS, 1):
        state = hosts.folder / f'home_{host}' / 'shards' / 'out' / 'state'
        parts = len(list((state / 'evaluation').glob('[!.]*')))
        check(parts == PARTS, f'{host} has {parts} parts, not those of shard {shard} alone')
    work.compare_with_local_run(alone / 'out', touchdown, hosts.work)


def main():
    os.environ['PATH'] += ':/usr/sbin:/sbin'
    absent = [name for name in ('ssh', 'ssh-keygen', 'sshd', 'rsync') if not shutil.which(name)]
    if absent:
        print(f'skipped: no {", ".join(absent)} here (Debian packages openssh-client, '
              'openssh-server and rsync)')
        return 77
    touchdown = pathlib.Path(sys.argv[1]).resolve()
    try:
        with Hosts(touchdown) as hosts:
            try:
                test(hosts, touchdown)
            except BaseException:
                print(hosts.logs())
                raise
    except DoesNotStart as why:
        print(f'skipped: {why}')
        return 77
    return 0


if __name__ == '__main__':
    sys.exit(main())
