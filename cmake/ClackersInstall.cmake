# What `cmake --install` puts where, in components that are also the Debian packages:
#   command      the program clackers
#   library      libclackers.so.0 for programs in C
#   development  headers, the modules as static libraries, find_package and pkg-config files
#   documentation  the manual, where CLACKERS_MANUAL names its folder
#   python       the package for Python, where CLACKERS_PYTHON is on
# Included after all targets exist.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/clackers)
get_property(modules GLOBAL PROPERTY CLACKERS_MODULES)

install(TARGETS clackers_cli RUNTIME COMPONENT command)
install(DIRECTORY bindings/matlab bindings/R COMPONENT command
  DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/clackers)
# The manual is built after the command, whose pages it shows.
install(CODE [[
  if(NOT "$ENV{CLACKERS_MANUAL}" STREQUAL "")
    file(INSTALL "$ENV{CLACKERS_MANUAL}/" DESTINATION "${CMAKE_INSTALL_PREFIX}/share/doc/clackers-doc/html")
  endif()]] COMPONENT documentation)
if(NOT CMAKE_CROSSCOMPILING)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/generated/share/ COMPONENT command
    DESTINATION ${CMAKE_INSTALL_DATAROOTDIR})
endif()

if(CLACKERS_PYTHON)
  set(CLACKERS_PYTHON_INSTALL_DIR lib/python3/dist-packages CACHE STRING
    "where the Python package is installed, below the prefix; Debian's place")
  install(TARGETS clackers_python LIBRARY COMPONENT python
    DESTINATION ${CLACKERS_PYTHON_INSTALL_DIR}/clackers)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/bindings/python/clackers COMPONENT python
    DESTINATION ${CLACKERS_PYTHON_INSTALL_DIR}
    FILES_MATCHING PATTERN *.py PATTERN *.pyi PATTERN py.typed PATTERN __pycache__ EXCLUDE)
  # By it pip and importlib.metadata know the package.
  configure_file(cmake/METADATA.in ${PROJECT_BINARY_DIR}/METADATA @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/METADATA COMPONENT python
    DESTINATION ${CLACKERS_PYTHON_INSTALL_DIR}/clackers-${PROJECT_VERSION}.dist-info)
endif()

# For C. Its targets stand in a file of their own: they need neither C++ nor the libraries below it.
install(TARGETS clackers_c EXPORT clackers-c
  LIBRARY COMPONENT library NAMELINK_COMPONENT development)
install(FILES bindings/c/clackers.h bindings/c/clackers_main.h TYPE INCLUDE COMPONENT development)
install(EXPORT clackers-c NAMESPACE clackers:: DESTINATION ${package_dir} COMPONENT development
  FILE clackers-c-targets.cmake)

# For C++: clackers::clackers is all modules, clackers::<module> one of them.
foreach(module IN ITEMS clackers options ${modules})
  set_target_properties(clackers_${module} PROPERTIES EXPORT_NAME ${module})
  install(TARGETS clackers_${module} EXPORT clackers-cpp ARCHIVE COMPONENT development)
endforeach()
install(EXPORT clackers-cpp NAMESPACE clackers:: DESTINATION ${package_dir} COMPONENT development
  FILE clackers-cpp-targets.cmake)

# Headers that only tests of this project include stay here; tests/package finds any that is not
# named.
set(test_headers testing/[a-z_]+ test_[a-z_]* toy_motion sample_record record_fingerprint synthetic_ladder
  expect_behaviour impact_simulator stepper_checks contact/runs toy_history sampled_motion
  shifted_history synthetic_runs true_history verdict_sequence sample_check)
list(JOIN test_headers "|" test_headers)
foreach(module IN LISTS modules)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
    ${PROJECT_SOURCE_DIR}/clackers/${module}/*.hpp)
  list(FILTER headers EXCLUDE REGEX "/(${test_headers})\\.hpp$|/testing/")
  foreach(header IN LISTS headers)
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/${header} COMPONENT development
      DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder})
  endforeach()
endforeach()

configure_package_config_file(cmake/clackers-config.cmake.in
  ${PROJECT_BINARY_DIR}/clackers-config.cmake INSTALL_DESTINATION ${package_dir}
  NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the C++ interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/clackers-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/clackers-config.cmake
  ${PROJECT_BINARY_DIR}/clackers-config-version.cmake
  DESTINATION ${package_dir} COMPONENT development)

# The prefix is told from where clackers.pc lies, so an installed tree may be moved.
file(RELATIVE_PATH pc_to_prefix /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(cmake/clackers.pc.in ${PROJECT_BINARY_DIR}/clackers.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/clackers.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
  COMPONENT development)

include(ClackersPackage)
