# Debian packages by CPack: clackers (the command), libclackers0 (the C library), libclackers-dev,
# python3-clackers where CLACKERS_PYTHON is on, and clackers-doc where the environment variable
# CLACKERS_MANUAL names the folder of the built manual. scripts/package makes them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME clackers)
set(CPACK_PACKAGE_VENDOR Clackers)
set(CPACK_PACKAGE_CONTACT "Clackers <clackers@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL command library development documentation)
if(CLACKERS_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# Asked at packing time, so that nothing of Debian is needed to configure.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME clackers)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION math)
set(CPACK_COMPONENT_COMMAND_DESCRIPTION
  "Exact motions of colliding masses, and verdicts on time-integration methods (command)
The command clackers prints exact motions with their impacts and judges
time-integration methods against them.")

set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "clackers-doc, libnetcdf19, libopenmpi3")

set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME clackers-doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION
  "Exact motions of colliding masses, and verdicts on time-integration methods (manual)
The manual as pages that open without a network: /usr/share/doc/clackers-doc/html/index.html")
# Read at packing time.
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/debian/manual.cmake)

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libclackers0)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
  "Exact motions of colliding masses (C library)
Opaque handles and status codes over the closed-form motions.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libclackers-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# The static libraries of C++ leave these to whoever links them; versions as in CMakeLists.txt.
set(development_depends "libclackers0 (= ${PROJECT_VERSION}-1)" "libeigen3-dev (>= 3.4)"
  "libfmt-dev (>= 9)" "nlohmann-json3-dev (>= 3.11)" "libboost-dev (>= 1.74)"
  "libhwy-dev (>= 1.0.3)" "libsqlite3-dev (>= 3.38)" libtomlplusplus-dev)
if(arb)
  list(APPEND development_depends libflint-arb-dev libflint-dev)
endif()
list(JOIN development_depends ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "Exact motions of colliding masses (development)
Headers for C and C++, static libraries for C++, and the files by which CMake
and pkg-config find them.")

if(CLACKERS_PYTHON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-clackers)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  # The extension module is for one minor version of Python.
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "libnetcdf19, python3-pandas, python3-matplotlib, python3-scipy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    "${PROJECT_SOURCE_DIR}/cmake/debian/postinst;${PROJECT_SOURCE_DIR}/cmake/debian/prerm")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "Exact motions of colliding masses, and verdicts on time-integration methods (Python)
The package clackers: cases, exact responses, impacts and tables as arrays of NumPy.")
endif()

# Packages of programs that link libclackers.so.0 learn their dependency on libclackers0 from its file
# shlibs. CPack adds the calls of ldconfig by itself.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE COMPONENT ${component}
    DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME}
    RENAME copyright)
endforeach()

include(CPack)
