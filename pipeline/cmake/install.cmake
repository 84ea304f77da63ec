# SPDX-License-Identifier: AGPL-3.0-or-later
# What `cmake --install` puts where, beside the stages: the make rules and scripts of a run with the cases, their front
# door, documents, manual pages and completion. The rules find the programs by the way from one folder to the other.
set(share ${CMAKE_INSTALL_DATADIR}/cutwater)
file(RELATIVE_PATH CUTWATER_BIN_FROM_SHARE ${CMAKE_INSTALL_FULL_DATADIR}/cutwater ${CMAKE_INSTALL_FULL_BINDIR})
file(RELATIVE_PATH CUTWATER_SHARE_FROM_BIN ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DATADIR}/cutwater)
configure_file(pipeline/installed.mk.in ${CMAKE_BINARY_DIR}/install/build.mk @ONLY)
configure_file(pipeline/packaging/cutwater.in ${CMAKE_BINARY_DIR}/install/cutwater @ONLY)

install(PROGRAMS ${CMAKE_BINARY_DIR}/install/cutwater DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY cases DESTINATION ${share})
install(FILES ${CMAKE_BINARY_DIR}/install/build.mk pipeline/require.mk pipeline/run.mk DESTINATION ${share}/pipeline)
file(GLOB scripts RELATIVE ${CMAKE_SOURCE_DIR} CONFIGURE_DEPENDS pipeline/*.py pipeline/solve/*.py)
foreach(script ${scripts})
  get_filename_component(folder ${script} DIRECTORY)
  install(PROGRAMS ${script} DESTINATION ${share}/${folder})
endforeach()
install(PROGRAMS pipeline/packaging/slurm.sh pipeline/packaging/pbs.sh DESTINATION ${share}/batch)
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN man EXCLUDE)
install(DIRECTORY docs/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
foreach(program cutwater cutwater-geometry cutwater-mesh cutwater-export cutwater-report)
  install(FILES pipeline/packaging/cutwater.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    RENAME ${program})
endforeach()
