# Installs BUILD somewhere, then moves the tree to TREE. Old files must not hide what is no longer installed.
file(REMOVE_RECURSE "${TREE}" "${TREE}.first")
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${TREE}.first COMMAND_ERROR_IS_FATAL ANY)
file(RENAME "${TREE}.first" "${TREE}")
