# SPDX-License-Identifier: AGPL-3.0-or-later
"""Cutwater for Spack, from a checkout or an unpacked archive:

  spack repo create ~/cutwater-repo local
  mkdir -p ~/cutwater-repo/packages/cutwater && cp package.py ~/cutwater-repo/packages/cutwater/
  spack repo add ~/cutwater-repo
  spack dev-build --source-path=/path/to/cutwater cutwater@main
"""
from spack.package import *

try:
    from spack_repo.builtin.build_systems.cmake import CMakePackage
except ImportError:  # before Spack 1.0, where spack.package brings it
    pass


class Cutwater(CMakePackage):
    """Preprocessor for centrifugal pumps: design, geometry, parallel hybrid mesh, CGNS, OpenFOAM and CFX cases."""

    license("AGPL-3.0-or-later")

    version("main")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.16:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("gmake", type=("build", "run"))
    depends_on("python@3.9:", type=("build", "run"))
    depends_on("mpi")
    depends_on("hdf5@1.10:")
    depends_on("opencascade@7.5: +data_exchange")
    depends_on("cgal@5:")
    depends_on("tetgen@1.5:1.5 +pic")
    depends_on("libfyaml")
    depends_on("jansson")
    depends_on("cairo")

    def cmake_args(self):
        return [self.define("CUTWATER_TESTS", False), self.define("HDF5_ROOT", self.spec["hdf5"].prefix),
                self.define("MPI_C_COMPILER", self.spec["mpi"].mpicc)]
