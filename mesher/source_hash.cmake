# SPDX-License-Identifier: AGPL-3.0-or-later
# Writes OUT, which defines the hash of source_hash.h over the sources in ROOT and what they share with other stages.
file(GLOB_RECURSE names RELATIVE ${ROOT} ${ROOT}/*.c ${ROOT}/*.cpp ${ROOT}/*.h)
file(GLOB shared RELATIVE ${ROOT} ${ROOT}/../pipeline/vec.h ${ROOT}/../pipeline/mesh/*.c ${ROOT}/../pipeline/mesh/*.h)
list(APPEND names ${shared})
list(SORT names)
set(all "")
foreach(name ${names})
  file(SHA256 ${ROOT}/${name} hash)
  string(APPEND all "${name} ${hash}\n")
endforeach()
string(SHA256 hash "${all}")
file(WRITE ${OUT} "#include \"mesher/source_hash.h\"\nconst char cw_source_hash[65] = \"${hash}\";\n")
