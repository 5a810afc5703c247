# SPDX-License-Identifier: BSD-3-Clause
# Installs BUILD somewhere, then moves the tree to TREE. Old files must not hide what is no longer installed.
file(REMOVE_RECURSE "${TREE}" "${TREE}.first")
# The list of what a person has installed is his.
set(manifest ${BUILD}/install_manifest.txt)
if(EXISTS ${manifest})
  file(RENAME ${manifest} ${manifest}.kept)
endif()
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${TREE}.first COMMAND_ERROR_IS_FATAL ANY)
file(RENAME "${TREE}.first" "${TREE}")
file(REMOVE ${manifest})
if(EXISTS ${manifest}.kept)
  file(RENAME ${manifest}.kept ${manifest})
endif()
