# Package config, pkg-config files and documents. Targets install themselves where they are defined.
include(CMakePackageConfigHelpers)

set(CARREAU_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/carreau)
set(CARREAU_FORTRAN_DIR ${CMAKE_INSTALL_DATADIR}/carreau/fortran)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/carreau-config.cmake.in ${PROJECT_BINARY_DIR}/carreau-config.cmake
  INSTALL_DESTINATION ${CARREAU_CONFIG_DIR} PATH_VARS CARREAU_FORTRAN_DIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/carreau-config-version.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT carreau-targets NAMESPACE carreau:: DESTINATION ${CARREAU_CONFIG_DIR} COMPONENT development)
install(FILES ${PROJECT_BINARY_DIR}/carreau-config.cmake ${PROJECT_BINARY_DIR}/carreau-config-version.cmake
  ${CMAKE_CURRENT_LIST_DIR}/CarreauBlsurf.cmake DESTINATION ${CARREAU_CONFIG_DIR} COMPONENT development)

# Relative to the file itself: the installed tree can be moved.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/pkgconfig
  OUTPUT_VARIABLE CARREAU_PC_TO_PREFIX)
string(REGEX REPLACE "/$" "" CARREAU_PC_TO_PREFIX "${CARREAU_PC_TO_PREFIX}")
set(pc_files carreau)
# What the library links: a program has to do so itself when the library is static.
set(CARREAU_PC_LIBS_PRIVATE "-lz -pthread")
if(CARREAU_TBB)
  string(APPEND CARREAU_PC_LIBS_PRIVATE " -ltbb")
endif()
if(CARREAU_OPENEXR)
  string(APPEND CARREAU_PC_LIBS_PRIVATE " -lOpenEXRCore")
endif()
foreach(library IN LISTS CARREAU_CXX_RUNTIME)
  string(APPEND CARREAU_PC_LIBS_PRIVATE " -l${library}")
endforeach()
if(BUILD_SHARED_LIBS)
  set(CARREAU_PC_LIBS_PUBLIC "")
else()
  set(CARREAU_PC_LIBS_PUBLIC " ${CARREAU_PC_LIBS_PRIVATE}")
endif()
if(CARREAU_FORTRAN)
  list(APPEND pc_files carreau-fortran)
  # Of the programs that carreau_add_blsurf makes.
  install(FILES ${PROJECT_SOURCE_DIR}/docs/man/blsurf.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT development)
endif()
foreach(name IN LISTS pc_files)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CHANGELOG.md TYPE DOC)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs TYPE DOC FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN man EXCLUDE)

if(PROJECT_IS_TOP_LEVEL)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/uninstall.cmake.in ${PROJECT_BINARY_DIR}/uninstall.cmake @ONLY)
  add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} -P ${PROJECT_BINARY_DIR}/uninstall.cmake VERBATIM)
endif()
