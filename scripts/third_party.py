#!/usr/bin/env python3
"""Lists what a program of exemplar is made with: third_party.py PROGRAM FOLDER

Writes THIRD_PARTY.md (packages, versions, licenses and where their texts are) and exemplar.spdx
(the same, SPDX 2.3) to FOLDER, from Debian's packages: the libraries that PROGRAM is linked with
as the loader finds them, and what is compiled into it."""

import hashlib
import os
import re
import subprocess
import sys

# Compiled in: static libraries and headers. three.js, in the report's page, comes from npm.
COMPILED_IN = [
    "libcadical-dev", "libcli11-dev", "libeigen3-dev", "libhwy-dev", "libmeshoptimizer-dev",
    "libtinygltf-dev", "libtomlplusplus-dev", "libxxhash-dev", "nlohmann-json3-dev",
]


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


def linked_packages(program):
    packages = set()
    for path in re.findall(r"=> (/\S+)", output("ldd", program)):
        # Debian 12 has /lib in /usr/lib; packages name either.
        real = os.path.realpath(path)
        for name in (real, real.removeprefix("/usr"), path):
            owner = output("dpkg-query", "-S", name).split(":")[0]
            if owner:
                packages.add(owner)
                break
    return packages


def licenses_of(package):
    path = f"/usr/share/doc/{package}/copyright"
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            text = file.read()
    except OSError:
        return ["NOASSERTION"], ""
    names = []
    for name in re.findall(r"^License: *(\S[^\n]*)$", text, re.M):
        if name not in names:
            names.append(name)
    return names or ["see the file"], path


def main():
    program, folder = sys.argv[1:]
    rows = []
    for package in sorted(linked_packages(program) | set(COMPILED_IN)):
        version = output("dpkg-query", "-W", "-f", "${Version}", package)
        if version:
            rows.append((package, version, *licenses_of(package)))
    if len(rows) < len(COMPILED_IN):
        sys.exit("third_party.py: the packages that exemplar is made with are not Debian's here")
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "THIRD_PARTY.md"), "w", encoding="utf-8") as file:
        file.write("# What exemplar is made with\n\n"
                   "Debian's packages, linked or compiled in. The report's page holds three.js (MIT).\n\n"
                   "| package | version | licenses in it | text |\n| --- | --- | --- | --- |\n")
        for package, version, licenses, path in rows:
            file.write(f"| {package} | {version} | {', '.join(licenses)} | {path} |\n")
    identity = hashlib.sha256(repr(rows).encode()).hexdigest()
    with open(os.path.join(folder, "exemplar.spdx"), "w", encoding="utf-8") as file:
        file.write("SPDXVersion: SPDX-2.3\nDataLicense: CC0-1.0\nSPDXID: SPDXRef-DOCUMENT\n"
                   "DocumentName: exemplar\n"
                   f"DocumentNamespace: https://spdx.org/spdxdocs/exemplar-{identity}\n"
                   "Creator: Organization: The exemplar authors\nCreated: 2026-01-01T00:00:00Z\n\n"
                   "PackageName: exemplar\nSPDXID: SPDXRef-exemplar\n"
                   "PackageDownloadLocation: NOASSERTION\nFilesAnalyzed: false\n"
                   "PackageLicenseConcluded: MIT\nPackageLicenseDeclared: MIT\n"
                   "PackageCopyrightText: NOASSERTION\n"
                   "Relationship: SPDXRef-DOCUMENT DESCRIBES SPDXRef-exemplar\n")
        for package, version, licenses, _ in rows:
            reference = "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", package)
            file.write(f"\nPackageName: {package}\nSPDXID: {reference}\n"
                       f"PackageVersion: {version}\nPackageDownloadLocation: NOASSERTION\n"
                       "FilesAnalyzed: false\nPackageLicenseConcluded: NOASSERTION\n"
                       "PackageLicenseDeclared: NOASSERTION\n"
                       f"PackageLicenseComments: <text>{', '.join(licenses)}</text>\n"
                       "PackageCopyrightText: NOASSERTION\n"
                       f"Relationship: SPDXRef-exemplar DEPENDS_ON {reference}\n")


main()
