#!/usr/bin/env python3
"""count_cases.py <report>: counts the cases in CTest's JUnit report, and prints one line about them.

A CTest test is a suite of GoogleTest, which prints a line about each of its cases, or is one case itself. A suite
that fails without a failed case has crashed or hung, in one more case. The exit code is 1 if a case failed, or if
there is none.
"""
import re
import sys
import xml.etree.ElementTree

END_OF_CASE = re.compile(r"^\[ +(OK|FAILED|SKIPPED) +\] \S+(?:, where .*)? \(\d+ ms\)$", re.MULTILINE)
OUTCOMES = {"run": "OK", "fail": "FAILED", "notrun": "SKIPPED", "disabled": "SKIPPED"}

count = {"OK": 0, "FAILED": 0, "SKIPPED": 0}
for test in xml.etree.ElementTree.parse(sys.argv[1]).getroot():
    cases = END_OF_CASE.findall(test.findtext("system-out") or "")
    outcome = OUTCOMES[test.get("status")]
    if not cases or (outcome == "FAILED" and "FAILED" not in cases):
        cases.append(outcome)
    for case in cases:
        count[case] += 1
print("touchdown: {OK} passed, {FAILED} failed, {SKIPPED} skipped".format(**count))
sys.exit(count["FAILED"] > 0 or count["OK"] == 0)
