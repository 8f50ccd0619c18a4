# What all targets share, and the function that makes a folder a room.

find_program(CCACHE ccache)
if(CCACHE)
  # Precompiled headers are kept apart by their content, not by their time.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
endif()

add_library(clackers_options INTERFACE)
target_compile_features(clackers_options INTERFACE cxx_std_20)
target_include_directories(clackers_options INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include>)
# Contracting a * b + c to one rounding would break the error-free sums of double_double.hpp, and
# make results depend on the machine.
target_compile_options(clackers_options INTERFACE -ffp-contract=off)
if(CLACKERS_DEVELOPER)
  # Never in an installed package: the next compiler may know a new warning.
  target_compile_options(clackers_options INTERFACE
    "$<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Werror>")
endif()

# clackers_room(<name> LINK <targets> [TEST_LINK <targets>]): the library clackers_<name> from
# clackers/<name>/**.cpp and, from its *_test.cpp, the test program clackers_<name>_test.
function(clackers_room name)
  cmake_parse_arguments(ARG "" "" "LINK;TEST_LINK;GENERATED" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/clackers/${name}/*.cpp)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(TRANSFORM ARG_LINK REPLACE "^([a-z]+)$" "clackers_\\1")
  if(sources OR ARG_GENERATED)
    add_library(clackers_${name} STATIC ${sources} ${ARG_GENERATED})
    target_link_libraries(clackers_${name} PUBLIC clackers_options ${ARG_LINK})
    # The rooms go into shared libraries, ours for C and those of consumers. Hidden, their functions
    # can still be inlined there and never meet another copy of themselves at run time.
    set_target_properties(clackers_${name} PROPERTIES
      POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  else()
    add_library(clackers_${name} INTERFACE)
    target_link_libraries(clackers_${name} INTERFACE clackers_options ${ARG_LINK})
  endif()
  add_library(clackers::${name} ALIAS clackers_${name})
  set_property(GLOBAL APPEND PROPERTY CLACKERS_ROOMS ${name})
  if(CLACKERS_TESTS AND tests)
    clackers_test(clackers_${name}_test SOURCES ${tests} LINK ${name} ${ARG_TEST_LINK})
  endif()
endfunction()

# clackers_all_rooms(): clackers::clackers, all rooms that were made until here.
function(clackers_all_rooms)
  get_property(rooms GLOBAL PROPERTY CLACKERS_ROOMS)
  list(TRANSFORM rooms PREPEND clackers_)
  add_library(clackers_clackers INTERFACE)
  add_library(clackers::clackers ALIAS clackers_clackers)
  target_link_libraries(clackers_clackers INTERFACE ${rooms})
endfunction()

# clackers_test_headers: what nearly every test includes, compiled once. It halves the time that
# tests take to compile. Rooms have none, so that their build sees each header alone.
function(clackers_test_headers)
  file(WRITE ${PROJECT_BINARY_DIR}/test_headers.cpp "")
  add_library(clackers_test_headers OBJECT ${PROJECT_BINARY_DIR}/test_headers.cpp)
  target_link_libraries(clackers_test_headers PRIVATE clackers_options Eigen3::Eigen GTest::gtest)
  target_compile_options(clackers_test_headers PRIVATE ${ARGN})
  target_precompile_headers(clackers_test_headers PRIVATE <gtest/gtest.h> <Eigen/Dense>)
endfunction()

# clackers_test(<name> SOURCES <files> LINK <rooms or targets>): a GoogleTest program.
function(clackers_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  list(TRANSFORM ARG_LINK REPLACE "^([a-z]+)$" "clackers_\\1")
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} clackers_options GTest::gtest_main)
  set(flags "")
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    # Half the time to compile; what takes time to run is in the rooms.
    set(flags -O0)
  endif()
  target_compile_options(${name} PRIVATE ${flags})
  if(CLACKERS_DEVELOPER)
    if(NOT TARGET clackers_test_headers)
      clackers_test_headers(${flags})
    endif()
    target_precompile_headers(${name} REUSE_FROM clackers_test_headers)
    # Without it ccache does not keep what was compiled with GCC's precompiled headers.
    target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES LABELS unit)
endfunction()
