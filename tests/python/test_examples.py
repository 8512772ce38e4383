import os
import re
import subprocess
import sys
import textwrap
import unittest

from scene import SOURCE, InFolder


def block(page, which):
    """One block of Python code in a page of the documents."""
    return re.findall(r"```python\n(.*?)```", (SOURCE / page).read_text(encoding="utf-8"), re.DOTALL)[which]


class Examples(InFolder):
    def output_of(self, *command, **env):
        done = subprocess.run([sys.executable, *map(str, command)], capture_output=True, text=True, check=False,
                              env={**os.environ, **env})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_first_steps(self):
        (self.folder / "none/matplotlib").mkdir(parents=True)
        (self.folder / "none/matplotlib/__init__.py").write_text("raise ImportError('none here')")
        path = f"{self.folder}/none{os.pathsep}{os.environ['PYTHONPATH']}"
        text = self.output_of(SOURCE / "examples/python/first_steps.py", PYTHONPATH=path)
        self.assertRegex(text, r"robust +success 0\.\d{4}, mean takeoff latency")
        self.assertIn("no matplotlib", text)

    def test_first_steps_draws_with_matplotlib(self):
        # A fake matplotlib, so that the drawing is tested everywhere.
        (self.folder / "drawn/matplotlib").mkdir(parents=True)
        (self.folder / "drawn/matplotlib/__init__.py").write_text("def use(backend): assert backend == 'Agg'")
        (self.folder / "drawn/matplotlib/pyplot.py").write_text(textwrap.dedent("""\
            from unittest import mock
            figure, axes = mock.MagicMock(), (mock.MagicMock(), mock.MagicMock())
            def subplots(*shape, **options):
                return figure, axes
            figure.savefig = lambda path, dpi: print("drawn", path, *(axes[0].plot.call_args[0][1].shape))
            """))
        path = f"{self.folder}/drawn{os.pathsep}{os.environ['PYTHONPATH']}"
        text = self.output_of(SOURCE / "examples/python/first_steps.py", "picture.png", PYTHONPATH=path)
        self.assertRegex(text, r"drawn picture.png \d{5} 2")

    def test_own_estimator(self):
        text = self.output_of(SOURCE / "examples/python/own_estimator.py")
        self.assertRegex(text, r"robust +success 0\.\d{4}\nmine +success 0\.\d{4}\n")
        rows = re.findall(r"python:__main__\.FallsOrPushes +\d N·m, \d m/s²: 0\.\d{4} \[", text)
        self.assertEqual(len(rows), 4)
        self.assertEqual(len(re.findall(r"^robust .* N·m", text, re.MULTILINE)), 4)

    def test_in_the_documents(self):
        for which in range(3):
            (self.folder / "page.py").write_text(block("docs/reference/python.md", which))
            self.output_of("page.py")


if __name__ == "__main__":
    unittest.main()
