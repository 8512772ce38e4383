"""Compiles the estimator and its tests for aarch64 and runs the tests in qemu. Compares the beliefs of
every kind of estimator for a synthetic run with its beliefs on this processor.

    aarch64_test.py SOURCE BUILD BELIEFS [TOUCHDOWN]

BUILD stays for the next run; BELIEFS is this processor's program. With the program TOUCHDOWN, the test
also fits a model, builds examples/robot with it against the installed library, and runs it. Exit code 77:
the compiler for aarch64, qemu, or the source of GoogleTest is missing.
"""

import pathlib
import re
import shutil
import subprocess
import sys

TOLERANCE = {'neural': 1e-5}  # which computes in single precision
DOUBLE = 1e-12
# Tests that take minutes in qemu.
SLOW = ('*BayesFilter*', '*SlidingDft*', '*TransitionSpectrum*', 'MeasurementOnly*', 'NeuralForward*')
NEEDED = {
    'g++-aarch64-linux-gnu': shutil.which('aarch64-linux-gnu-g++'),
    'qemu-user': shutil.which('qemu-aarch64'),
    'googletest': pathlib.Path('/usr/src/googletest/CMakeLists.txt').exists(),
}


def run(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(f'{" ".join(map(str, command))}\nfailed with {done.returncode}:\n{done.stdout}')
    return done.stdout


def beliefs(text):
    """By estimator: for every step its probabilities, and its decisions with the status."""
    steps = {}
    for line in text.splitlines():
        name, _, *numbers = line.split()
        steps.setdefault(name, []).append(([float(p) for p in numbers[:4]], numbers[4:]))
    return steps


def robots_program(source, build, touchdown, qemu):
    """Builds and runs a robot's program outside of the source tree, with a model that is fitted here."""
    work = build / 'robot'
    shutil.rmtree(work, ignore_errors=True)
    shutil.copytree(source / 'examples/robot', work / 'source')
    run(touchdown, 'simulate', source / 'scenarios/stairs.yaml', '--run', '1', '-o', work / 'stairs.mpack')
    run(touchdown, 'fit', work / 'stairs.mpack', '--estimator', 'robust', '-o', work / 'model.npz')
    run(touchdown, 'convert', work / 'model.npz', '-o', work / 'model.hpp')
    run('cmake', '--install', build, '--prefix', work / 'prefix')
    run('cmake', '-S', work / 'source', '-B', work / 'build', '-G', 'Ninja', '--toolchain',
        source / 'scripts/cmake/aarch64-linux-gnu.cmake', f'-DCMAKE_PREFIX_PATH={work / "prefix"}',
        f'-Dtouchdown_DIR={work / "prefix/lib/cmake/touchdown"}', f'-DMODEL_HEADER={work / "model.hpp"}')
    run('cmake', '--build', work / 'build')
    output = run(*qemu, work / 'build/robot_without_files')
    assert output.count('takes off') == 10 and output.count('touches down') == 9, output
    print('robot_without_files on aarch64:', *output.splitlines()[-2:], sep='\n  ')


def main():
    source, build, program, *touchdown = map(pathlib.Path, sys.argv[1:])
    missing = [package for package, there in NEEDED.items() if not there]
    if missing:
        print(f'skipped: packages are missing: {", ".join(missing)}')
        return 77

    run('cmake', '-S', source, '-B', build, '-G', 'Ninja', '--toolchain',
        source / 'scripts/cmake/aarch64-linux-gnu.cmake', '-DCMAKE_BUILD_TYPE=Release',
        '-DTOUCHDOWN_ESTIMATOR_ONLY=ON', '-DTOUCHDOWN_TESTS=ON', '-DCMAKE_UNITY_BUILD=ON')
    run('cmake', '--build', build, '--parallel', '1')  # other tests run beside this one

    qemu = ('qemu-aarch64', '-L', '/usr/aarch64-linux-gnu')
    output = run(*qemu, build / 'test_estimator', '--gtest_brief=1',
                 f'--gtest_filter=-{":".join(SLOW)}')
    passed = re.search(r'\[  PASSED  \] (\d+) tests', output)
    assert passed and int(passed[1]) > 50, output
    print(f'{passed[1]} tests of the estimator pass on aarch64')

    there = beliefs(run(*qemu, build / 'estimator_beliefs'))
    here = beliefs(run(program))
    assert there.keys() == here.keys() and len(here) == 8, (there.keys(), here.keys())
    apart = []
    for name, expected in here.items():
        found = there[name]
        assert len(found) == len(expected), name
        left = [p[0] for p, _ in expected]
        assert max(left) - min(left) > 0.2, f'{name}: beliefs hardly vary'
        difference = max(abs(a - b) for (p, _), (q, _) in zip(found, expected) for a, b in zip(p, q))
        decisions = sum(d != e for (_, d), (_, e) in zip(found, expected))
        print(f'{name}: {len(found)} steps, beliefs within {difference:.1e}, '
              f'{decisions} other decisions')
        if not difference <= TOLERANCE.get(name, DOUBLE) or decisions:
            apart.append(name)
    assert not apart, apart
    if touchdown:
        robots_program(source, build, touchdown[0], qemu)
    return 0


if __name__ == '__main__':
    sys.exit(main())
