# SPDX-License-Identifier: AGPL-3.0-or-later
"""The archive of `make dist`: it builds where there is no git, and its programs say which commit they are. Ends with
77, skipped, where the source itself is no checkout of git."""
import os
import sys
import tarfile
import unittest
from pathlib import Path

from cutwater import SOURCE, execute, fresh, said


class Archive(unittest.TestCase):
    def test_it_builds_without_git(self):
        top = fresh("archive")
        archive = Path(said(self, ["make", "-s", "-C", SOURCE, "dist", f"BUILD={top}"]).splitlines()[-1])
        with tarfile.open(archive) as file:
            file.extractall(top)
        source = top / archive.name.removesuffix(".tar.gz")
        version = source.name.removeprefix("cutwater-")
        commit = execute(["git", "-C", SOURCE, "rev-parse", "--short", "HEAD"]).stdout.strip()
        self.assertTrue(version.endswith(commit) or "+" not in version and "-" not in version, (version, commit))
        no_git = top / "bin"  # stands before git itself
        no_git.mkdir()
        (no_git / "git").write_text("#!/bin/sh\nexit 1\n")
        (no_git / "git").chmod(0o755)
        path = f"PATH={no_git}:{os.environ['PATH']}"
        for line in (["cmake", "-S", source, "-B", top / "build", "-DCUTWATER_TESTS=OFF"],
                     ["cmake", "--build", top / "build", "-j", 2, "--target", "cutwater-report"],
                     [top / "build/bin/cutwater-report", "--version"]):
            told = said(self, ["env", path, *line])
        self.assertEqual(told, f"cutwater-report {version}\n")


if __name__ == "__main__":
    if execute(["git", "-C", SOURCE, "rev-parse"]).returncode:
        print("no checkout of git: skipped")
        sys.exit(77)
    unittest.main()
