# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""The list of what the command is made with is SPDX 2.3 in tag-value form and names it all:
third_party_test.py SCRIPT PROGRAM. Debian 12 has no program that validates such files; licenses are
checked by python3-license-expression, where it is installed."""

import os
import re
import subprocess
import sys
import tempfile
import unittest

SCRIPT, PROGRAM = sys.argv[1:3]
# Clause 6, and 7 of a package.
OF_DOCUMENT = ["SPDXVersion", "DataLicense", "SPDXID", "DocumentName", "DocumentNamespace", "Creator",
               "Created"]
OF_PACKAGE = ["PackageName", "SPDXID", "PackageDownloadLocation"]


def problems_of(text):
    """What is wrong with a file, as lines."""
    found = []
    for line in text.split("\n"):
        if line and not re.match(r"^\w+: \S", line):
            found.append("no tag: " + line)
    packages, document = [], {}
    for tag, value in re.findall(r"^(\w+): (.*)$", text, re.M):
        if tag == "PackageName":
            packages.append({})
        of = packages[-1] if packages else document
        if tag in of and tag != "Relationship":
            found.append(f"{tag} twice: {value}")
        of.setdefault(tag, []).append(value)
    for needed, holder in [(OF_DOCUMENT, document)] + [(OF_PACKAGE, p) for p in packages]:
        found += [f"no {tag} in {holder}" for tag in needed if tag not in holder]
    names = [holder["SPDXID"][0] for holder in [document, *packages] if "SPDXID" in holder]
    if len(set(names)) < len(names):
        found.append("an SPDXID is used twice")
    found += ["bad SPDXID " + name for name in names if not re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", name)]
    for holder in [document, *packages]:
        for relation in holder.get("Relationship", []):
            ends = relation.split(" ")
            if len(ends) != 3 or ends[0] not in names or ends[2] not in names:
                found.append("bad Relationship " + relation)
        for tag in ("PackageLicenseDeclared", "PackageLicenseConcluded"):
            found += [f"{tag} {text}" for text in holder.get(tag, []) if not known_license(text)]
    if document.get("SPDXVersion") != ["SPDX-2.3"] or document.get("DataLicense") != ["CC0-1.0"]:
        found.append("neither version nor license of a document of SPDX 2.3")
    return found


def known_license(text):
    if text in ("NOASSERTION", "NONE"):
        return True
    try:
        from license_expression import get_spdx_licensing
    except ImportError:
        return bool(re.fullmatch(r"[A-Za-z0-9.+-]+(?: (?:AND|OR|WITH) [A-Za-z0-9.+-]+)*", text))
    return not get_spdx_licensing().validate(text).errors


class ThirdParty(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        held = tempfile.TemporaryDirectory()
        cls.addClassCleanup(held.cleanup)
        cls.folder = held.name
        subprocess.run([sys.executable, SCRIPT, PROGRAM, cls.folder], check=True)

    def read(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return file.read()

    def test_is_spdx(self):
        text = self.read("exemplar.spdx")
        self.assertEqual(problems_of(text), [])
        for wrong in (text.replace("SPDXID: SPDXRef-three\n", ""), text.replace("MPL-2.0", "MPL 2"),
                      text + "Relationship: SPDXRef-exemplar DEPENDS_ON SPDXRef-nothing\n",
                      text.replace("SPDXRef-three", "SPDXRef-libcadical-dev")):
            self.assertNotEqual(problems_of(wrong), [])

    def test_names_every_library_that_is_loaded(self):
        table = self.read("THIRD_PARTY.md")
        loaded = subprocess.run(["ldd", PROGRAM], capture_output=True, text=True, check=True).stdout
        for library, name in (("libopenvdb", "libopenvdb"), ("libtbb", "libtbb"), ("libpng", "libpng"),
                              ("libembree3", "libembree3"), ("libtiff", "libtiff")):
            self.assertIn(library, loaded)
            self.assertRegex(table, rf"\n\| {name}\S* \| \S+ \| (?!NOASSERTION)\S+ ")
        self.assertIn("\n| three | ", table)
        texts = os.listdir(os.path.join(self.folder, "third_party"))
        self.assertGreater(len(texts), 20)
        for package in re.findall(r"^\| (\S+) \|.*\| /usr/share/doc/", table, re.M):
            self.assertIn(package, texts)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
