# SPDX-License-Identifier: AGPL-3.0-or-later
"""What programs of others say of a run, for the tests that ask them."""
import re

from cutwater import execute, said

CHECK_MESH = ["checkMesh", "-allGeometry", "-allTopology"]
SOLVER_FAILED = r"\bnan\b|FOAM FATAL|sigFpe::sigHandler"


def cgns_is_sound(test, file, zones):
    """cgnscheck reads so many zones of the file to its end and complains of nothing; what it says."""
    told = said(test, ["cgnscheck", "-v", file])
    test.assertIn("checking complete", told)
    test.assertEqual([line for line in told.splitlines() if re.search("ERROR|WARNING", line)], [])
    test.assertEqual(len(re.findall(r'^reading zone "?\w+', told, re.M)), zones, told)
    return told


def failed_checks(told):
    """Of what checkMesh says the checks that fail."""
    return re.findall(r"\*\*\*(.*)", told)


def interfaces_are_covered(test, told, least=0.98):
    """checkMesh tells of interfaces, and their faces meet those of the other side. Returns "source" or "target" of each
    side told of."""
    weights = re.findall(r"AMI: Patch (source|target) sum\(weights\) min:(\S+) max:(\S+)", told)
    test.assertTrue(weights, told[-2000:])
    for side, low, high in weights:
        test.assertGreater(float(low), least, side)
        test.assertLess(float(high), 1.02, side)
    return [side for side, _, _ in weights]


def set_iterations(case, iterations):
    execute(["foamDictionary", "-entry", "endTime", "-set", iterations, "system/controlDict"], case)


def flow_begins(test, case, iterations):
    """simpleFoam makes so many iterations; what it says."""
    set_iterations(case, iterations)
    return said(test, ["simpleFoam"], case, timeout=3000)


def continuity_errors(test, told):
    """Of each iteration of a solver that met no fault."""
    test.assertNotRegex(told, SOLVER_FAILED)
    return [float(error) for error in re.findall(r"continuity errors : sum local = (\S+),", told)]


def reports(case, name, file):
    """The rows of numbers of a function object, of all starts."""
    for path in sorted((case / "postProcessing" / name).glob(f"*/{file}"), key=lambda path: float(path.parent.name)):
        for line in path.read_text().splitlines():
            if not line.startswith("#") and line.strip():
                yield [float(word) for word in re.sub("[()]", " ", line).split()]
