#!/usr/bin/env python3
"""figures.py PROGRAM [IMAGE...]: draws the pictures of docs/images again, all of them or those named.

Each comes from an experiment's run directory, a scene at one moment, or a command. Experiments run once, under
runs/figures. All of them take some twenty minutes of two cores. Look at every picture afterwards.
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
IMAGES = ROOT / 'docs' / 'images'
RUNS = ROOT / 'runs' / 'figures'

STAIRS = ['experiments/stairs.yaml']
NOISE = ['experiments/noise_study.yaml']
KERB = ['experiments/causes.yaml']
SQUAT = [*KERB, '--set=test.scenarios=[scenarios/squat.yaml]', '--set=detail.at=2.5', '--set=detail.before=1.0',
         '--set=detail.after=0.8']

# image: (arguments of `touchdown run`, file in the run directory)
OF_RUNS = {
    'figure_error.png': (STAIRS, 'figures/error_mujoco.png'),
    'figure_densities.png': (STAIRS, 'figures/densities_mujoco.png'),
    'figure_reliability.png': (STAIRS, 'figures/reliability_mujoco.png'),
    'figure_latency.png': (STAIRS, 'figures/latency_mujoco.png'),
    'noise_study_mujoco.png': (NOISE, 'figures/error_mujoco.png'),
    'noise_study_bullet.png': (NOISE, 'figures/error_bullet.png'),
    'noise_study_knee_wheel_mujoco.png': (NOISE, 'figures/knee_wheel_mujoco.png'),
    'noise_study_detail_mujoco.png': (NOISE, 'figures/detail_mujoco.png'),
    'noise_study_detail_bullet.png': (NOISE, 'figures/detail_bullet.png'),
    'drop_overlay.png': (['experiments/cross_simulator.yaml'], 'figures/drop_overlay.png'),
    'causes_robust_kerb.png': (KERB, 'figures/detail_mujoco.png'),
    'causes_robust_squat.png': (SQUAT, 'figures/detail_mujoco.png'),
}

# image: (scenario, moment in seconds, more arguments of `touchdown simulate`)
OF_SCENES = {
    'scenario_stairs.png': ('stairs', 8.53),
    'scenario_stairs_authors.png': ('stairs_authors', 11.55),
    'scenario_course.png': ('course', 6.3),
    'scenario_roam.png': ('roam', 6.0, '--run', 3),
    'scenario_hang.png': ('hang', 3.0),
    'scenario_push_off.png': ('push_off', 1.76, '--run', 2),
    'scenario_lift.png': ('lift', 5.45, '--run', 0),
    'scenario_flat.png': ('flat', 3.0),
}


# Side by side in robots.png.
ROBOTS = ['upkie.xml', 'upkie_straight.yaml', 'upkie_large_wheels.yaml', 'upkie_long_legs.yaml', 'upkie_asymmetric.yaml']


def call(*command, folder=ROOT):
    subprocess.run(list(map(str, command)), cwd=folder, check=True, stdout=subprocess.DEVNULL)


class Painter:
    def __init__(self, program):
        self.program = program
        self.finished = {}

    def run(self, arguments):
        """The run directory of an experiment, which runs once."""
        key = tuple(arguments)
        if key not in self.finished:
            folder = RUNS / f'{pathlib.Path(arguments[0]).stem}_{len(self.finished)}'
            call(self.program, 'run', *arguments, '--out', folder, '--overwrite')
            self.finished[key] = folder
        return self.finished[key]

    def scene(self, image, scenario, moment, *settings, width=640, height=360):
        with tempfile.TemporaryDirectory() as folder:
            recording = pathlib.Path(folder, 'run.mpack')
            call(self.program, 'simulate', f'scenarios/{scenario}.yaml', *settings, '-o', recording)
            call(self.program, 'render', recording, '-o', image, '--poster', '--scene', '--from', moment, '--width', width,
                 '--height', height)

    def robots(self, image):
        with tempfile.TemporaryDirectory() as folder:
            pictures = [pathlib.Path(folder, f'{number}.png') for number in range(len(ROBOTS))]
            for picture, robot in zip(pictures, ROBOTS):
                self.scene(picture, 'flat', 1, '--set', f'robot=models/{robot}', width=500, height=640)
            inputs = [word for picture in pictures for word in ('-i', picture)]
            crops = ''.join(f'[{number}]crop=320:380:90:120[robot{number}];' for number in range(len(pictures)))
            row = ''.join(f'[robot{number}]' for number in range(len(pictures))) + f'hstack=inputs={len(pictures)}'
            call('ffmpeg', '-y', '-loglevel', 'error', *inputs, '-filter_complex', crops + row, image)

    def log(self, image):
        with tempfile.TemporaryDirectory() as folder:
            call(self.program, 'simulate', ROOT / 'scenarios/stairs.yaml', '--run', 3, '-o', 'robot.mpack', folder=folder)
            call(self.program, 'estimate', 'robot.mpack', '--figure', 'log.png', folder=folder)
            shutil.copyfile(pathlib.Path(folder, 'log.png'), image)

    def draw(self, name):
        image = IMAGES / name
        if name in OF_RUNS:
            arguments, file = OF_RUNS[name]
            shutil.copyfile(self.run(arguments) / file, image)
        elif name in OF_SCENES:
            self.scene(image, *OF_SCENES[name])
        elif name == 'robot_log.png':
            self.log(image)
        elif name == 'robots.png':
            self.robots(image)
        elif name == 'stairs_both_engines.jpg':
            call(self.program, 'render', self.run(STAIRS), '-o', image, '--poster', '--layout', 'side-by-side',
                 '--from', 3.08)
        elif name == 'closed_loop.jpg':
            film = self.run(['experiments/closed_loop.yaml']) / 'videos' / 'closed_loop_mujoco.mp4'
            call('ffmpeg', '-y', '-loglevel', 'error', '-ss', 6, '-i', film, '-frames:v', 1, image)
        elif name == 'performance.png':
            call(sys.executable, 'tests/benchmarks/experiments/scaling.py', self.program, 'docs/images/performance')
        else:
            sys.exit(f'{name}: no recipe')


OTHERS = {'robot_log.png', 'robots.png', 'stairs_both_engines.jpg', 'closed_loop.jpg', 'performance.png'}


def names():
    """Every picture with a recipe."""
    return sorted({*OF_RUNS, *OF_SCENES, *OTHERS})


def main(program, chosen):
    painter = Painter(program)
    for name in chosen or names():
        print(name, flush=True)
        painter.draw(name)


if __name__ == '__main__':
    main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:])
