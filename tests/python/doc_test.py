# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""What docstrings and docs/*.md show after >>> is what Python answers."""

import doctest
import glob
import os
import re
import sys
import unittest

import exemplar

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FLAGS = doctest.ELLIPSIS | doctest.IGNORE_EXCEPTION_DETAIL


def answered(examples):
    """(tried, failed) of a doctest; what differs is printed."""
    runner = doctest.DocTestRunner(optionflags=FLAGS)
    runner.run(examples, out=sys.stderr.write)
    return runner.tries, runner.failures


def of_text(text, name):
    return doctest.DocTestParser().get_doctest(text, {}, name, name, 0)


class Documentation(unittest.TestCase):
    def test_docstrings(self):
        finder, tried = doctest.DocTestFinder(exclude_empty=True), 0
        for name in ["", *exemplar.__all__]:
            thing = getattr(exemplar, name) if name else exemplar
            for examples in finder.find(thing, "exemplar." + name, module=False,
                                        globs=dict(vars(exemplar))):
                if not examples.examples or (not name and examples.name != "exemplar."):
                    continue
                with self.subTest(examples.name):
                    some, failed = answered(examples)
                    self.assertEqual(failed, 0)
                    tried += some
        self.assertGreaterEqual(tried, 15)

    def test_pages(self):
        tried = 0
        for path in sorted(glob.glob(os.path.join(ROOT, "docs", "*.md"))):
            with open(path, encoding="utf-8") as file:
                blocks = re.findall(r"^```python\n(.*?)^```", file.read(), re.M | re.S)
            text = "\n".join(block for block in blocks if ">>>" in block)
            if text:
                with self.subTest(os.path.basename(path)):
                    some, failed = answered(of_text(text, os.path.basename(path)))
                    self.assertEqual(failed, 0)
                    tried += some
        self.assertGreaterEqual(tried, 12)

    def test_a_wrong_answer_is_found(self):
        runner = doctest.DocTestRunner(optionflags=FLAGS)
        runner.run(of_text(">>> 1 + 1\n3\n", "wrong"), out=lambda text: None)
        self.assertEqual((runner.tries, runner.failures), (1, 1))


if __name__ == "__main__":
    unittest.main()
