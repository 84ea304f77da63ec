# SPDX-License-Identifier: AGPL-3.0-or-later
# Sets version to what this source is: 0.1.0 for the commit tagged v0.1.0, 0.1.0-3-g3f2a9c1 for the third after it,
# 0.1.0+3f2a9c1 where that tag is not known, with .changed where files differ from the commit; in a release archive what
# pipeline/VERSION tells. Writes it to OUT where another stands there, as C where that is a file *.c.
#   cmake -DROOT=. [-DOUT=FILE] -P version.cmake
file(STRINGS ${ROOT}/CMakeLists.txt number REGEX "^project\\(cutwater VERSION ")
string(REGEX REPLACE "^.*VERSION ([0-9.]+).*$" "\\1" number "${number}")
if(EXISTS ${ROOT}/pipeline/VERSION)
  file(STRINGS ${ROOT}/pipeline/VERSION version LIMIT_COUNT 1)
else()
  execute_process(COMMAND git -C ${ROOT} describe --always --dirty=.changed --tags --match v${number}
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(failed OR commit STREQUAL "")
    set(commit "unknown")
  endif()
  string(REGEX REPLACE "^v${number}" "${number}" version "${commit}")
  if(version STREQUAL commit)
    set(version "${number}+${commit}")
  endif()
endif()
if(OUT)
  set(text "${version}\n")
  if(OUT MATCHES "\\.c$")
    set(text "#include \"pipeline/version.h\"\nconst char cw_version[] = \"${version}\";\n")
  endif()
  set(there "")
  if(EXISTS ${OUT})
    file(READ ${OUT} there)
  endif()
  if(NOT there STREQUAL text)
    file(WRITE ${OUT} "${text}")
  endif()
endif()
