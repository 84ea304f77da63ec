# SPDX-License-Identifier: AGPL-3.0-or-later
# The HDF5 for MPI that goes with the MPI that is found: target ParallelHDF5::hdf5. Where HDF5_ROOT or HDF5_DIR names
# one, that; else that of pkg-config, on Debian hdf5-openmpi or hdf5-mpich, elsewhere hdf5; else what CMake's FindHDF5
# finds. One without MPI, or with another MPI, is passed over.
include(CheckCSourceCompiles)
include(CMakePushCheckState)
include(FindPackageHandleStandardArgs)
find_package(PkgConfig QUIET)

cmake_push_check_state(RESET)
set(CMAKE_REQUIRED_LIBRARIES MPI::MPI_C)
check_c_source_compiles("#include <mpi.h>\n#ifndef OPEN_MPI\n#error\n#endif\nint main(void) { return 0; }"
  CUTWATER_OPEN_MPI)
cmake_pop_check_state()

# Whether each MPI that the libraries name as needed is the one that is found.
function(cutwater_one_mpi libraries result)
  set(found "")
  foreach(library ${MPI_C_LIBRARIES})
    get_filename_component(library ${library} REALPATH)
    string(APPEND found " ${library}")
  endforeach()
  set(one TRUE)
  foreach(library ${libraries})
    if(EXISTS ${library})
      file(STRINGS ${library} needed REGEX "^libmpi(ch)?\\.so\\.[0-9]+$")
      foreach(name ${needed})
        string(FIND "${found}" "/${name}" at)
        if(at LESS 0)
          set(one FALSE)
        endif()
      endforeach()
    endif()
  endforeach()
  set(${result} ${one} PARENT_SCOPE)
endfunction()

# Sets ParallelHDF5_LIBRARIES to that of the candidate where a program with it compiles and links, and it is of this
# MPI.
function(cutwater_try_hdf5 includes libraries)
  if(ParallelHDF5_LIBRARIES)
    return()
  endif()
  file(WRITE ${CMAKE_BINARY_DIR}/try_hdf5/try.c
    "#include <hdf5.h>\n#include <mpi.h>\n#ifndef H5_HAVE_PARALLEL\n#error\n"
    "#endif\nint main(void) { return H5Pset_fapl_mpio(0, MPI_COMM_WORLD, MPI_INFO_NULL); }\n")
  try_compile(links ${CMAKE_BINARY_DIR}/try_hdf5 ${CMAKE_BINARY_DIR}/try_hdf5/try.c
    CMAKE_FLAGS "-DINCLUDE_DIRECTORIES=${includes}" LINK_LIBRARIES ${libraries} MPI::MPI_C)
  cutwater_one_mpi("${libraries}" one)
  if(links AND one)
    set(ParallelHDF5_INCLUDE_DIRS "${includes}" CACHE STRING "Headers of parallel HDF5")
    set(ParallelHDF5_LIBRARIES "${libraries}" CACHE STRING "Libraries of parallel HDF5")
  endif()
endfunction()

function(cutwater_try_hdf5_cmake)
  set(HDF5_PREFER_PARALLEL TRUE)
  find_package(HDF5 QUIET COMPONENTS C)
  if(HDF5_FOUND)
    cutwater_try_hdf5("${HDF5_INCLUDE_DIRS}" "${HDF5_LIBRARIES}")
  endif()
endfunction()

set(names hdf5-mpich hdf5)
if(CUTWATER_OPEN_MPI)
  set(names hdf5-openmpi hdf5)
endif()
if(HDF5_ROOT OR HDF5_DIR OR DEFINED ENV{HDF5_ROOT} OR NOT PKG_CONFIG_FOUND)
  set(names)
endif()
foreach(name ${names})
  pkg_check_modules(PC_${name} QUIET ${name})
  if(PC_${name}_FOUND)
    cutwater_try_hdf5("${PC_${name}_INCLUDE_DIRS}" "${PC_${name}_LINK_LIBRARIES}")
  endif()
endforeach()
cutwater_try_hdf5_cmake()

find_package_handle_standard_args(ParallelHDF5 REQUIRED_VARS ParallelHDF5_LIBRARIES FAIL_MESSAGE
  "no HDF5 built for this MPI (${MPI_C_LIBRARIES}): on Debian libhdf5-openmpi-dev or libhdf5-mpich-dev, elsewhere \
hdf5 with MPI, whose prefix -DHDF5_ROOT=... tells")
if(ParallelHDF5_FOUND AND NOT TARGET ParallelHDF5::hdf5)
  add_library(ParallelHDF5::hdf5 INTERFACE IMPORTED)
  set_target_properties(ParallelHDF5::hdf5 PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${ParallelHDF5_INCLUDE_DIRS}"
    INTERFACE_LINK_LIBRARIES "${ParallelHDF5_LIBRARIES};MPI::MPI_C")
endif()
