"""Every picture of the pages has a recipe, every recipe a picture, and every picture a page."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / 'scripts' / 'documents'))
import figures  # noqa: E402


class Figures(unittest.TestCase):
    def test_have_recipes(self):
        pictures = {file.name for file in (ROOT / 'docs' / 'images').iterdir()}
        self.assertEqual(pictures, set(figures.names()))

    def test_are_shown_on_pages(self):
        text = ''.join(page.read_text(encoding='utf-8') for page in [ROOT / 'README.md', *(ROOT / 'docs').rglob('*.md')])
        shown = set(re.findall(r'images/([\w.]+)\)', text))
        self.assertEqual(shown, {file.name for file in (ROOT / 'docs' / 'images').iterdir()})

    def test_come_from_experiments_scenes_and_robots_that_exist(self):
        for arguments, _ in figures.OF_RUNS.values():
            self.assertTrue((ROOT / arguments[0]).exists(), arguments)
        for scenario, *_ in figures.OF_SCENES.values():
            self.assertTrue((ROOT / 'scenarios' / f'{scenario}.yaml').exists(), scenario)
        for robot in figures.ROBOTS:
            self.assertTrue((ROOT / 'models' / robot).exists(), robot)


if __name__ == '__main__':
    unittest.main()
