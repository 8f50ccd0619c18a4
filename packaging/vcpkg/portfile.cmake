# Not run; see ../README.md.
vcpkg_download_distfile(archive URLS SOURCE/clackers-0.1.0.tar.gz FILENAME clackers-0.1.0.tar.gz SHA512 0)
vcpkg_extract_source_archive(source ARCHIVE ${archive})
vcpkg_cmake_configure(SOURCE_PATH ${source} OPTIONS -DCLACKERS_TESTS=OFF -DCLACKERS_MPI=OFF -DCLACKERS_INSTALL=ON)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/clackers)
file(REMOVE_RECURSE ${CURRENT_PACKAGES_DIR}/debug/include)
vcpkg_install_copyright(FILE_LIST ${source}/LICENSE)
