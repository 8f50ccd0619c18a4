# What all targets share, and the function that makes a folder a module.

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
# Loads what is used alone.
target_link_options(clackers_options INTERFACE $<BUILD_INTERFACE:LINKER:--as-needed>)
option(CLACKERS_UNITY "Compile small sources in batches" ON)
if(CLACKERS_DEVELOPER)
  set(shadow -Wshadow)
  if(CLACKERS_UNITY)
    # Names of other sources of the batch do not count.
    set(shadow $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>)
  endif()
  # Never in an installed package: the next compiler may know a new warning.
  target_compile_options(clackers_options INTERFACE
    "$<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wconversion;-Werror;${shadow}>")
endif()

# Hardening of what is built for use: canaries on the stack, checked copies, and tables of addresses
# that are read-only once the program runs. The command is position-independent, too. tests/package
# reads it. Sanitizers have their own checks.
include(CheckPIESupported)
check_pie_supported(LANGUAGES CXX)
set(for_use $<CONFIG:Release,RelWithDebInfo,MinSizeRel>)
if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  target_compile_options(clackers_options INTERFACE
    "$<BUILD_INTERFACE:$<${for_use}:-fstack-protector-strong;-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=3>>")
  target_link_options(clackers_options INTERFACE
    "$<BUILD_INTERFACE:$<${for_use}:LINKER:-z,relro,-z,now>>")
endif()

if(NOT DEFINED CMAKE_UNITY_BUILD_BATCH_SIZE)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)
endif()
# clackers_unity(<target>): the sources of a target are compiled in batches, which halves the time of a
# clean build; docs/decisions/0008. Names at file scope are therefore unique within a target.
function(clackers_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${CLACKERS_UNITY})
endfunction()

# clackers_module(<name> LINK <targets> [TEST_LINK <targets>]): the library clackers_<name> from
# clackers/<name>/**.cpp or <name>/**.cpp and, from its *_test.cpp, the test program clackers_<name>_test.
# What tests share, <name>/testing/*.cpp, is the library clackers_<name>_testing.
function(clackers_module name)
  cmake_parse_arguments(ARG "" "" "LINK;TEST_LINK;GENERATED" ${ARGN})
  set(folder ${PROJECT_SOURCE_DIR}/clackers/${name})
  if(NOT EXISTS ${folder})
    set(folder ${PROJECT_SOURCE_DIR}/${name})
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  set(tests ${sources})
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  set(shared ${sources})
  list(FILTER shared INCLUDE REGEX "/testing/")
  list(FILTER sources EXCLUDE REGEX "/testing/")
  list(TRANSFORM ARG_LINK REPLACE "^([a-z]+)$" "clackers_\\1")
  if(sources OR ARG_GENERATED)
    add_library(clackers_${name} STATIC ${sources} ${ARG_GENERATED})
    target_link_libraries(clackers_${name} PUBLIC clackers_options ${ARG_LINK})
    # The modules go into shared libraries, ours for C and those of consumers. Hidden, their functions
    # can still be inlined there and never meet another copy of themselves at run time.
    set_target_properties(clackers_${name} PROPERTIES
      POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    clackers_precompile(clackers_${name} modules)
    clackers_unity(clackers_${name})
  else()
    add_library(clackers_${name} INTERFACE)
    target_link_libraries(clackers_${name} INTERFACE clackers_options ${ARG_LINK})
  endif()
  add_library(clackers::${name} ALIAS clackers_${name})
  set_property(GLOBAL APPEND PROPERTY CLACKERS_MODULES ${name})
  if(CLACKERS_TESTS AND shared)
    add_library(clackers_${name}_testing STATIC ${shared})
    target_link_libraries(clackers_${name}_testing PUBLIC clackers_${name} ${ARG_TEST_LINK} GTest::gtest)
    clackers_precompile(clackers_${name}_testing tests)
    clackers_unity(clackers_${name}_testing)
    list(PREPEND ARG_TEST_LINK clackers_${name}_testing)
  endif()
  if(CLACKERS_TESTS AND tests)
    clackers_test(${name} SOURCES ${tests} LINK ${name} ${ARG_TEST_LINK})
  endif()
endfunction()

# clackers_all_modules(): clackers::clackers, all modules that were made until here.
function(clackers_all_modules)
  get_property(modules GLOBAL PROPERTY CLACKERS_MODULES)
  list(TRANSFORM modules PREPEND clackers_)
  add_library(clackers_clackers INTERFACE)
  add_library(clackers::clackers ALIAS clackers_clackers)
  target_link_libraries(clackers_clackers INTERFACE ${modules})
endfunction()

# clackers_headers(<set> HEADERS <headers> OPTIONS <flags> LINK <targets>): headers that are compiled
# once, for all targets that name the set in clackers_precompile. tests/layering compiles each header
# of ours without them.
function(clackers_headers set)
  cmake_parse_arguments(ARG "" "" "HEADERS;OPTIONS;LINK" ${ARGN})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/headers/${set}.cpp CONTENT "")
  add_library(clackers_${set}_headers OBJECT ${PROJECT_BINARY_DIR}/headers/${set}.cpp)
  target_link_libraries(clackers_${set}_headers PRIVATE clackers_options ${ARG_LINK})
  target_compile_options(clackers_${set}_headers PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(clackers_${set}_headers PRIVATE ${ARG_HEADERS})
  set_target_properties(clackers_${set}_headers PROPERTIES CLACKERS_HEADERS_OPTIONS "${ARG_OPTIONS}")
endfunction()

function(clackers_precompile target set)
  target_precompile_headers(${target} REUSE_FROM clackers_${set}_headers)
  # Headers that were compiled with other options are refused.
  get_target_property(options clackers_${set}_headers CLACKERS_HEADERS_OPTIONS)
  target_compile_options(${target} PRIVATE ${options})
  # Without it ccache does not keep what was compiled with GCC's precompiled headers.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# clackers_test(<name> SOURCES <files> LINK <modules or targets> [SHARDS <n>]): a GoogleTest program
# clackers_<name>_test and its test unit.<name>, which starts it once, or n times for a share each.
function(clackers_test name)
  cmake_parse_arguments(ARG "" "SHARDS" "SOURCES;LINK" ${ARGN})
  list(TRANSFORM ARG_LINK REPLACE "^([a-z]+)$" "clackers_\\1")
  set(program clackers_${name}_test)
  add_executable(${program} ${ARG_SOURCES})
  target_link_libraries(${program} PRIVATE ${ARG_LINK} clackers_options GTest::gtest_main)
  if(NOT TARGET clackers_tests_headers)
    set(flags "")
    if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
      # Half the time to compile; what takes time to run is in the modules.
      set(flags -O0)
    endif()
    clackers_headers(tests HEADERS <gtest/gtest.h> <Eigen/Dense> OPTIONS ${flags} LINK Eigen3::Eigen GTest::gtest)
    add_custom_target(clackers_unit_tests)
  endif()
  # Step loops are templates: the linker would take the copies that the tests compile without optimisation.
  if(NOT (name STREQUAL methods AND CMAKE_CXX_FLAGS MATCHES "-fsanitize"))
    clackers_precompile(${program} tests)
  endif()
  clackers_unity(${program})
  add_dependencies(clackers_unit_tests ${program})
  if(NOT ARG_SHARDS AND CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    set(ARG_SHARDS 4)  # minutes otherwise, on one processor
    # Their long runs take up to 100 times as long, since vectors are not optimised; tests beside them run the same code.
    set(filter "GTEST_FILTER=-Path.S*:Path.R*:Path.T*:Path.F*:Check.FindsNothingWrong*:Verify.Keeps*:Verify.MeasuresMetrics*:SolversUnderTest.AreToldTheCause*")
  elseif(NOT ARG_SHARDS)
    set(ARG_SHARDS 1)
  endif()
  math(EXPR last "${ARG_SHARDS} - 1")
  foreach(shard RANGE ${last})
    set(test unit.${name})
    if(last)
      string(APPEND test .${shard})
    endif()
    add_test(NAME ${test} COMMAND ${program} --gtest_brief=1)
    set_tests_properties(${test} PROPERTIES LABELS quick TIMEOUT 600
      ENVIRONMENT "GTEST_TOTAL_SHARDS=${ARG_SHARDS};GTEST_SHARD_INDEX=${shard};${filter}")
  endforeach()
endfunction()
