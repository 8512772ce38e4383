"""A small experiment, and the comparison of two runs of it."""

import hashlib
import re
import subprocess
import pathlib

SCENARIO = """name: step
terrain:
  pieces:
    - flat: {length: 3.0}
    - stairs: {count: 1, run: 3.0, rise: 0.25, nosing_radius: 0.025}
start: {x: 0.7}
velocity: [{time: 0.3, velocity: 0.5}]
end: {duration: 2.5}
perturbation: {velocity: 0.1, yaw: 0.05}
"""
EXPERIMENT = """name: tiny
seed: 3
simulators: [mujoco, bullet]
estimators: [robust, measurement_only, upkie_observer]
fit: {scenarios: [step.yaml]}
test: {scenarios: [step.yaml], runs: {runs}}
noise: {torque: [0.0, 0.5, 1.0, 1.5, 2.0, 4.0], accelerometer: [0.0, 2.0, 4.0, 6.0, 8.0], seeds: {seeds}}
highlights: [{torque: 1.0, accelerometer: 4.0}]
intervals: {resamples: 100}
video: {enabled: false}
"""


def check(good, what):
    if not good:
        raise AssertionError(what)


def results_in(path):
    """The content of a file without the section of the report on how it was computed."""
    content = path.read_bytes()
    return content.partition(b'id="reproduce"')[0] if path.name == 'report.html' else content


def checksums(directory):
    """Checksums of all results by name, without the manifest, state/ and logs/, which contain times."""
    return {str(path.relative_to(directory)): hashlib.sha256(results_in(path)).hexdigest()
            for path in directory.rglob('*')
            if path.is_file() and path.name != 'manifest.json'
            and path.relative_to(directory).parts[0] not in ('state', 'logs')}


def write_experiment(folder, runs, seeds):
    """Writes tiny.yaml: `runs` runs in two engines, each evaluated with `seeds` noise seeds."""
    (folder / 'step.yaml').write_text(SCENARIO)
    (folder / 'tiny.yaml').write_text(
        EXPERIMENT.replace('{runs}', str(runs)).replace('{seeds}', str(seeds)))


def compare_with_local_run(results, touchdown, folder):
    """Checks that every file in `results` equals that of a single run."""
    local = folder / 'local'
    if not local.exists():
        subprocess.run([touchdown, 'run', 'tiny.yaml', '--out', local], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
    found, expected = checksums(results), checksums(local)
    check(len(expected) > 20 and 'tables/success.csv' in expected, expected)
    different = {name for name in found.keys() | expected.keys() if found.get(name) != expected.get(name)}
    check(not different, f'not the files of a local run: {sorted(different)}')
    print(f'{len(found)} files are those of a local run')


def recipe(title, **variables):
    """The commands under this title in docs/guides/shards.md, with other values for the variables of
    their first line."""
    text = (pathlib.Path(__file__).resolve().parents[2] / 'docs' / 'guides' / 'shards.md').read_text()
    lines = re.search(rf'^## {re.escape(title)}$.*?^```bash\n(.*?)^```$', text, re.M | re.S)[1]
    first, rest = lines.split('\n', 1)
    for name, value in variables.items():
        first, found = re.subn(rf'(^| ){name}=(\([^)]*\)|\S+)', rf'\1{name}={value}', first)
        check(found == 1, f'{title}: no {name} in its first line')
    return first + '\n' + rest
