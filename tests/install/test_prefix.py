# SPDX-License-Identifier: AGPL-3.0-or-later
"""`cmake --install` into a prefix: what is there names no path of the source, and runs a case through all stages. The
source is hidden from that run where mount namespaces are allowed. Manual pages are those of --help."""
import os
import re
import shutil
import tempfile
import unittest
from pathlib import Path

from cutwater import BIN, SOURCE, execute, without_make

PROGRAMS = ["cutwater", *(f"cutwater-{stage}" for stage in ("geometry", "mesh", "export", "report"))]
HIDE = ["unshare", "--mount", "--propagation", "private",
        "sh", "-c", f'mount -t tmpfs none {SOURCE} && exec "$@"', "sh"]


def call(*line, folder="/", path=""):
    return execute(line, folder, 900, without_make(path))


class Prefix(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.top = Path(tempfile.mkdtemp(prefix="cutwater"))
        cls.prefix, cls.work = cls.top / "prefix", cls.top / "work"
        cls.work.mkdir()
        cls.told = call("cmake", "--install", BIN.parent, "--prefix", cls.prefix, "--strip")
        cls.hide = HIDE if call(*HIDE, "true").returncode == 0 else []

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.top)

    def run_here(self, *line):
        return call(*self.hide, *line, folder=self.work, path=self.prefix / "bin")

    def test_the_files(self):
        self.assertEqual(self.told.returncode, 0, self.told.stdout)
        share = self.prefix / "share"
        for program in PROGRAMS:
            for path in (f"bin/{program}", f"share/man/man1/{program}.1",
                         f"share/bash-completion/completions/{program}"):
                self.assertTrue((self.prefix / path).is_file(), path)
        self.assertTrue((share / "doc/cutwater/docs/user-guide.md").is_file())
        for path in self.prefix.rglob("*"):
            if path.is_file() and not path.read_bytes().startswith(b"\x7fELF"):
                self.assertNotIn(os.fsencode(SOURCE), path.read_bytes(), path)

    def test_a_case_runs_through_all_stages(self):
        shutil.copytree(self.prefix / "share/cutwater/cases/paper", self.work / "cases/mine")
        names = self.run_here("cutwater").stdout.split()
        self.assertIn("mine", names)
        self.assertIn("zones", names)
        result = self.run_here("cutwater", "mine", "CELLS=150k", "OUT=here", "NP=2")
        self.assertEqual(result.returncode, 0, result.stdout)
        for name in ("export/pump.cgns", "export/openfoam/Allrun", "report/index.html"):
            self.assertTrue((self.work / "here" / name).is_file(), name)
        self.assertNotIn(str(SOURCE), (self.work / "here/report/index.html").read_text())
        again = self.run_here("cutwater", "mine", "CELLS=150k", "OUT=here", "NP=2")
        self.assertNotIn("cutwater-", again.stdout, "no stage runs again")
        side_by_side = self.run_here("cutwater", "report", ".")
        self.assertEqual((side_by_side.returncode, side_by_side.stdout), (0, "./index.html  1 runs side by side\n"))
        self.assertIn("here/report/index.html", (self.work / "index.html").read_text())
        refused = self.run_here("cutwater", "report")
        self.assertEqual((refused.returncode, refused.stdout),
                         (1, "compare: error: runs: no such folder; allowed: a folder of runs, such as runs\n"))
        refused = self.run_here("cutwater", "nothing")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("no case is called 'nothing'; allowed: ", refused.stdout)

    def test_all_are_of_one_version(self):
        told = [self.run_here(program, "--version").stdout for program in PROGRAMS]
        self.assertEqual(told[0], told[1])
        self.assertEqual(len({line.split()[1] for line in told}), 1, told)
        self.assertRegex(told[0], r"^cutwater-geometry \d+\.\d+\.\d+\S*\n$")

    def test_manual_pages_are_those_of_help(self):
        made = self.top / "man"
        made.mkdir()
        call("python3", SOURCE / "pipeline/packaging/man_pages.py", BIN, made)
        for program in PROGRAMS:
            kept = SOURCE / f"docs/man/{program}.1"
            self.assertEqual((made / kept.name).read_text(), kept.read_text(),
                             "python3 pipeline/packaging/man_pages.py build/bin docs/man makes them anew")

    def test_batch_scripts(self):
        stand_in = self.top / "stand-in"
        stand_in.mkdir()
        (stand_in / "cutwater").write_text('#!/bin/sh\nprintf "%s|" "$PWD" "$@"\n')
        (stand_in / "cutwater").chmod(0o755)
        for script, given, told in (
                ("slurm.sh", ["CELLS=2M"], f"{self.work}|paper|CELLS=2M|LAUNCHER=srun --mpi=pmix|"),
                ("slurm.sh", ["CASE=zones", "OUT=x"], f"{self.work}|zones|OUT=x|LAUNCHER=srun --mpi=pmix|"),
                ("pbs.sh", ["PBS_O_WORKDIR=/", "PBS_NODEFILE=/n/1"], "/|paper|HOSTS=/n/1|")):
            path = self.prefix / "share/cutwater/batch" / script
            result = call("env", *given, "bash", path, folder=self.work, path=stand_in)
            self.assertEqual((result.returncode, result.stdout), (0, told))

    def completed(self, *words):
        """What bash offers for the last word."""
        script = self.prefix / "share/bash-completion/completions/cutwater"
        line = f'. {script}; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _cutwater; echo "${{COMPREPLY[@]}}"'
        return set(self.run_here("bash", "-c", line, "bash", *words).stdout.split())

    def test_completion(self):
        self.assertEqual(self.completed("cutwater-mesh", "--st"), {"--stop-after"})
        self.assertEqual(self.completed("cutwater-report", "--c"), {"--case", "--cells"})
        self.assertEqual(self.completed("cutwater-mesh", "--case", ""), set())
        self.assertEqual(self.completed("cutwater", "nq24"), {"nq24", "nq24-faces", "nq24-solve", "nq24-curve",
                                                              "nq24-sweep"})
        self.assertEqual(self.completed("cutwater", "HO"), {"HOSTS="})
        self.assertEqual(self.completed("cutwater", "rep"), {"report"})
        self.assertEqual(self.completed("cutwater", "report", ""), set())
        options = re.findall(r"^  (--[a-z-]+)", self.run_here("cutwater-mesh", "--help").stdout, re.M)
        self.assertEqual(self.completed("cutwater-mesh", "--"), set(options))


if __name__ == "__main__":
    unittest.main()
