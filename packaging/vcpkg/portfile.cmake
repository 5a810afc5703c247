# SPDX-License-Identifier: BSD-3-Clause
vcpkg_download_distfile(archive
  URLS "https://example.org/carreau-${VERSION}.tar.gz"
  FILENAME "carreau-${VERSION}.tar.gz"
  SHA512 0)
vcpkg_extract_source_archive(source ARCHIVE "${archive}")
vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES cad CARREAU_OPENCASCADE)
vcpkg_cmake_configure(SOURCE_PATH "${source}" OPTIONS ${features} -DCARREAU_WERROR=OFF -DCARREAU_TESTS=OFF -DCARREAU_FORTRAN=OFF
  -DCARREAU_OPENEXR=OFF -DCARREAU_MED=OFF -DCARREAU_PYTHON=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/carreau)
vcpkg_copy_tools(TOOL_NAMES carreau AUTO_CLEAN)
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${source}/LICENSE")
