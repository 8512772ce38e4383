import importlib.util
import os
import pathlib
import subprocess
import sys
import unittest

import touchdown
from scene import SOURCE, InFolder

PIP = all(importlib.util.find_spec(module) for module in ("pip", "venv", "setuptools", "wheel"))
WORKS = "import touchdown; print(touchdown.simulate('scenarios/hop.yaml', overrides={'end.duration': 0.1}).steps)"


def output_of(*command, **options):
    """The output of a command, without the built package on Python's path."""
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False,
                          env={**environment, **options.pop("env", {})}, **options)
    if done.returncode:
        raise AssertionError(f"{command}: {done.stdout}{done.stderr}")
    return done.stdout.strip()


class Installed(InFolder):
    def check(self, python, package, env):
        """Checks that the package works from any folder, with its own files."""
        self.assertEqual(output_of(python, "-c", WORKS, cwd="/", env=env), "101")
        own = package / "share/touchdown/scenarios/found_beside_the_module.yaml"
        own.write_text("name: here\n")
        find = "import touchdown; print(touchdown._touchdown.find_resource('scenarios/found_beside_the_module.yaml'))"
        self.assertEqual(output_of(python, "-c", find, cwd="/", env=env), str(own))
        for brought in ("models/upkie.xml", "models/nmn.npz", "scenarios/stairs.yaml", "experiments/stairs.yaml",
                        "noise/profiles/upkie.yaml", "examples/mapping/robot.yaml", "examples/mapping/robot.csv",
                        "examples/mapping/ros2_bag.yaml", "commit"):
            self.assertTrue((package / "share/touchdown" / brought).is_file(), brought)
        self.assertTrue((package / "py.typed").is_file())

    @unittest.skipUnless(PIP, "needs Debian's python3-pip, python3-venv, python3-setuptools, python3-wheel")
    def test_by_pip_without_a_network(self):
        output_of(sys.executable, "-m", "venv", "--system-site-packages", "venv")
        python = self.folder / "venv/bin/python"
        # pip uses the existing build.
        output_of(python, "-m", "pip", "install", "--no-build-isolation", "--no-index", "--no-cache-dir", SOURCE,
             env={"TOUCHDOWN_BUILD": os.environ["TOUCHDOWN_BUILD"]})
        package = pathlib.Path(output_of(python, "-c", "import touchdown; print(touchdown.__path__[0])", cwd="/"))
        self.assertEqual(package.parents[3], self.folder / "venv")
        self.check(python, package, {})
        self.assertLess(sum(path.stat().st_size for path in package.rglob("*")), 11e6)  # with what draws pictures
        self.assertIn(f"Version: {touchdown.__version__}", output_of(python, "-m", "pip", "show", "touchdown"))
        self.assertIn("--set KEY=VALUE", output_of(python, "-m", "touchdown", "run", "--help"))

    def test_by_cmake(self):
        output_of("cmake", "--install", os.environ["TOUCHDOWN_BUILD"], "--component", "python", "--prefix", self.folder)
        package, = self.folder.glob("lib/python*/dist-packages/touchdown")
        self.check(sys.executable, package, {"PYTHONPATH": str(package.parent)})


if __name__ == "__main__":
    unittest.main()
