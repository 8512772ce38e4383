"""The part of `pip install .` that compiles: CMake builds the module and lists the files of the package."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent


class BuildByCMake(build_ext):
    """Builds in its own folder, or in the configured folder that TOUCHDOWN_BUILD names."""

    def build_extension(self, ext):
        given = os.environ.get("TOUCHDOWN_BUILD")
        build = pathlib.Path(given or self.build_temp).resolve()
        if not given:
            subprocess.run(["cmake", "--preset", "program", "-S", SOURCE, "-B", build, "-DTOUCHDOWN_PYTHON=ON",
                            f"-DPython_EXECUTABLE={sys.executable}"], cwd=SOURCE, check=True)
        subprocess.run(["cmake", "--build", build, "--target", "touchdown_python"], check=True)
        # The folder of the package's files; a package that is installed in place is imported from it.
        package = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        with tempfile.TemporaryDirectory() as stage:
            subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", stage, "--strip"],
                           check=True)
            installed, = pathlib.Path(stage).rglob("touchdown/__init__.py")
            shutil.copytree(installed.parent, package, dirs_exist_ok=True)


setup(
    version=re.search(r"VERSION ([\d.]+) LANGUAGES", (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8"))[1],
    ext_modules=[Extension("touchdown._touchdown", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
)
