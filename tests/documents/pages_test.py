"""The pages: each is of one kind and found from the index; its tables are whole."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / 'docs'
KINDS = {'tutorials', 'guides', 'explanation', 'reference'}
OF_NO_KIND = {'README.md', 'results.md', 'limits.md'}


def uneven_rows(text):
    """Rows of tables with another number of cells than their header; a bar in code counts, as for GitHub."""
    columns, in_code = 0, False
    for line in text.splitlines():
        in_code = line.startswith('```') != in_code
        cells = len(re.findall(r'(?<!\\)\|', line)) if line.startswith('|') and not in_code else 0
        if cells and columns and cells != columns:
            yield line
        columns = columns or cells if cells else 0


class Pages(unittest.TestCase):
    def setUp(self):
        self.pages = sorted(DOCS.rglob('*.md'))

    def test_are_of_one_kind_each(self):
        for page in self.pages:
            place = page.relative_to(DOCS)
            self.assertTrue(place.parts[0] in KINDS and len(place.parts) == 2 or str(place) in OF_NO_KIND, place)

    def test_are_all_in_the_index(self):
        index = (DOCS / 'README.md').read_text(encoding='utf-8')
        linked = {(DOCS / link.split('#')[0]).resolve() for link in re.findall(r'\]\(([^)]+)\)', index)}
        missing = [str(page.relative_to(DOCS)) for page in self.pages if page.resolve() not in linked]
        self.assertEqual(missing, ['README.md'])

    def test_name_no_former_command(self):
        source = (ROOT / 'apps/cli/command_line.cpp').read_text(encoding='utf-8')
        former = re.findall(r'FormerVerb\{"(\w+)"', source)
        self.assertIn('label', former)
        named = re.compile(rf'(`|\btouchdown )({"|".join(former)})(`| [A-Z-])')
        for text in ('intervals of `label`', 'touchdown export FILE'):
            self.assertTrue(named.search(text), text)
        for page in [*self.pages, ROOT / 'README.md', ROOT / 'CONTRIBUTING.md']:
            self.assertEqual(named.findall(page.read_text(encoding='utf-8')), [], page)

    def test_have_tables_with_rows_of_equal_length(self):
        for page in [*self.pages, ROOT / 'README.md', ROOT / 'CHANGELOG.md', ROOT / 'CONTRIBUTING.md']:
            self.assertEqual(list(uneven_rows(page.read_text(encoding='utf-8'))), [], page)

    def test_with_uneven_tables_are_noticed(self):
        table = '| a | b |\n|---|---|\n| {} | d |\n'
        for cell, count in (('c', 0), ('`x \\| y`', 0), ('`x | y`', 1), ('c | e', 1)):
            self.assertEqual(len(list(uneven_rows(table.format(cell)))), count, cell)
        self.assertEqual(list(uneven_rows('```\n' + table.format('c | e') + '```\n')), [])


if __name__ == '__main__':
    unittest.main()
