#!/usr/bin/env python3
"""Lists what a program of exemplar is made with: third_party.py PROGRAM FOLDER

Writes THIRD_PARTY.md (packages, versions, licenses and where their texts are), third_party/ (those
texts) and exemplar.spdx (the list, SPDX 2.3) to FOLDER, from Debian's packages: the libraries that
PROGRAM is linked with as the loader finds them, and what is compiled into it."""

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# What the authors of these say of the library itself; a package's copyright file, which is listed,
# too, also names the licenses of its build scripts and tests. The longest beginning counts.
DECLARED = {
    "libopenvdb": "MPL-2.0", "libtbb": "Apache-2.0", "libembree": "Apache-2.0",
    "libopenmesh": "BSD-3-Clause", "libpng": "libpng-2.0", "libtiff": "libtiff",
    "libjpeg62-turbo": "IJG AND BSD-3-Clause AND Zlib", "zlib1g": "Zlib",
    "libboost": "BSL-1.0", "libimath": "BSD-3-Clause", "libopenexr": "BSD-3-Clause",
    "libcadical": "MIT", "libcli11": "BSD-3-Clause", "libeigen3": "MPL-2.0",
    "libhwy": "Apache-2.0 OR BSD-3-Clause", "libmeshoptimizer": "MIT", "libtinygltf": "MIT",
    "libtomlplusplus": "MIT", "libxxhash": "BSD-2-Clause", "nlohmann-json3": "MIT",
    "libstdc++6": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "libgcc-s1": "GPL-3.0-or-later WITH GCC-exception-3.1", "libc6": "LGPL-2.1-or-later",
    "libblosc": "BSD-3-Clause", "liblz4": "BSD-2-Clause", "libzstd": "BSD-3-Clause",
    "libsnappy": "BSD-3-Clause", "liblzma5": "0BSD", "libdeflate": "MIT", "libjbig": "GPL-2.0-or-later",
    "liblerc": "Apache-2.0", "libwebp": "BSD-3-Clause", "three": "MIT",
    "libcpp-httplib": "MIT", "libssl": "Apache-2.0", "libbrotli": "MIT",
}

# Compiled in: static libraries and headers. three.js, in the report's page, comes from npm.
COMPILED_IN = [
    "libcadical-dev", "libcli11-dev", "libeigen3-dev", "libhwy-dev", "libmeshoptimizer-dev",
    "libtinygltf-dev", "libtomlplusplus-dev", "libxxhash-dev", "nlohmann-json3-dev",
]


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


def linked_packages(program):
    names = []
    for path in re.findall(r"=> (/\S+)", output("ldd", program)):
        # Debian 12 has /lib in /usr/lib; packages name either.
        real = os.path.realpath(path)
        names += [real, real.removeprefix("/usr"), path]
    # One line for each that is known: PACKAGE:ARCHITECTURE: NAME.
    return {line.split(":")[0] for line in output("dpkg-query", "-S", *names).splitlines()}


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


def declared_for(package):
    known = [name for name in DECLARED if package.startswith(name)]
    return DECLARED[max(known, key=len)] if known else "NOASSERTION"


def three_js():
    """What the report's page holds, from npm."""
    with open(os.path.join(ROOT, "web", "package.json"), encoding="utf-8") as file:
        packages = json.load(file)
    version = {**packages.get("devDependencies", {}), **packages.get("dependencies", {})}["three"]
    return ("three", version.lstrip("^~"), ["MIT"], "")


def main():
    program, folder = sys.argv[1:]
    rows = [three_js()]
    for package in sorted(linked_packages(program) | set(COMPILED_IN)):
        version = output("dpkg-query", "-W", "-f", "${Version}", package)
        if version:
            rows.append((package, version, *licenses_of(package)))
    if len(rows) <= len(COMPILED_IN):
        sys.exit("third_party.py: the packages that exemplar is made with are not Debian's here")
    texts = os.path.join(folder, "third_party")
    shutil.rmtree(texts, ignore_errors=True)
    os.makedirs(texts)
    for package, _, _, path in rows:
        if path:
            shutil.copyfile(path, os.path.join(texts, package))
    with open(os.path.join(folder, "THIRD_PARTY.md"), "w", encoding="utf-8") as file:
        file.write("# What exemplar is made with\n\n"
                   "Debian's packages, linked or compiled in, and three.js, which the report's page "
                   "holds.\n\n| package | version | license | named in its copyright file | text |\n"
                   "| --- | --- | --- | --- | --- |\n")
        for package, version, licenses, path in rows:
            file.write(f"| {package} | {version} | {declared_for(package)} | "
                       f"{', '.join(licenses)} | {path} |\n")
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
                       f"PackageLicenseDeclared: {declared_for(package)}\n"
                       f"PackageLicenseComments: <text>{', '.join(licenses)}</text>\n"
                       "PackageCopyrightText: NOASSERTION\n"
                       f"Relationship: SPDXRef-exemplar DEPENDS_ON {reference}\n")


main()
