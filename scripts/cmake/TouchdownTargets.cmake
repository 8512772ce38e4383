# Makes a target of every folder of the project, with the same standard, warnings and include root.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

# Looked for once: a ccache that is installed later (with the packages of the tests) would change every
# command, and so compile the whole program again.
if(NOT DEFINED CCACHE)
  find_program(CCACHE ccache)
endif()
# ccache needs this setting before it keeps objects that were compiled with a precompiled header.
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
endif()

# Warnings are errors for us; `cmake --compile-no-warning-as-error` is for other people's compilers.
if(NOT DEFINED CMAKE_COMPILE_WARNING_AS_ERROR)
  set(CMAKE_COMPILE_WARNING_AS_ERROR ON)
endif()

# g++ 12 asks the processor for the whole level. A compiler that cannot ask, or another
# architecture, fails to compile this and gets the portable code.
# (Debian 12's CMake crashes when it runs a program that was compiled for another processor.)
if(CMAKE_CROSSCOMPILING)
  set(TOUCHDOWN_HOST_IS_X86_64_V3 OFF)
else()
  include(CheckCXXSourceRuns)
  check_cxx_source_runs(
    "int main() { return __builtin_cpu_supports(\"x86-64-v3\") ? 0 : 1; }"
    TOUCHDOWN_HOST_IS_X86_64_V3)
endif()

# Flags of all the project's code. They stay in this build tree and are never installed.
# `-fno-math-errno` lets square roots vectorise. g++ collects its garbage above half a GiB: it then takes
# up to a tenth less time for a sixth more memory.
add_library(touchdown_flags INTERFACE)
target_compile_options(touchdown_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion
  # In sources that are compiled together, a private name of another file is no outer name.
  $<$<NOT:$<BOOL:$<TARGET_PROPERTY:TOUCHDOWN_IS_TEST>>>:-Wshadow> -fno-math-errno
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>
  $<$<AND:$<BOOL:${TOUCHDOWN_NATIVE}>,$<BOOL:${TOUCHDOWN_HOST_IS_X86_64_V3}>>:-march=x86-64-v3>)
target_include_directories(touchdown_flags INTERFACE ${PROJECT_SOURCE_DIR})

# Reading headers takes most of a source's compile time. The headers below, which most sources include,
# are precompiled once for all of them. A source still includes what it uses.
# touchdown_precompile(<target>): uses the headers below.
# touchdown_precompile(<target> <target> [<header>...]): precompiles the headers below and the given ones
# for this target: it has its own options, or all its sources include the same large library.
# touchdown_precompile(<target> <owner>): uses the headers that <owner> precompiled.
set(TOUCHDOWN_PRECOMPILED
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <list> <map>
  <memory> <mutex> <numeric> <optional> <set> <span> <string> <string_view> <utility> <variant> <vector>
  <Eigen/Core> <Eigen/Geometry>)
function(touchdown_precompile target)
  if(TOUCHDOWN_ESTIMATOR_ONLY)
    return()
  endif()
  # Programs are compiled position-independent, as the libraries that share the headers.
  target_compile_options(${target} PRIVATE -fpch-preprocess -fPIC)
  set(owner touchdown_precompiled)
  if(ARGN)
    list(POP_FRONT ARGN owner)
  endif()
  if(owner STREQUAL target)
    target_precompile_headers(${target} PRIVATE ${TOUCHDOWN_PRECOMPILED} ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
  if(owner MATCHES "_precompiled$")
    # Every target that reuses the headers needs the definitions they were compiled with.
    target_compile_definitions(${target} PRIVATE
      $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
  endif()
endfunction()

# Optimization takes a third of a source's compile time. It pays in the folders that compute numbers for
# every step. The others, and the tests, spend their run time there and in libraries: they get -O1, with the
# rounding of -O3.
# touchdown_optimize_less(<target>)
function(touchdown_optimize_less target)
  target_compile_options(${target} PRIVATE $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-O1;-fexpensive-optimizations>)
endfunction()

if(NOT TOUCHDOWN_ESTIMATOR_ONLY)
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  find_package(fmt REQUIRED)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled.cpp CONTENT "")
  foreach(owner touchdown_precompiled touchdown_computing_precompiled)
    add_library(${owner} OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
    target_link_libraries(${owner} PRIVATE touchdown_flags Eigen3::Eigen fmt::fmt)
    touchdown_precompile(${owner} ${owner} <fmt/format.h> <yaml-cpp/yaml.h>)
  endforeach()
  touchdown_optimize_less(touchdown_precompiled)
endif()

# Reading headers and starting the compiler take most of a source's compile time. Sources are therefore
# compiled together, as one source that includes them: those of a folder up to nine at a time, those of
# tests up to 80 kB (2,000 lines) at a time. A change to one recompiles all; -DTOUCHDOWN_UNITY=OFF avoids that.
option(TOUCHDOWN_UNITY "Compile the sources of a folder a few at a time" ON)
# touchdown_unity(<target> <source>...)
function(touchdown_unity target)
  set(folders "")
  foreach(source ${ARGN})
    cmake_path(GET source PARENT_PATH folder)
    list(APPEND folders ${folder})
    string(MAKE_C_IDENTIFIER ${folder} id)
    list(APPEND in_${id} ${source})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder ${folders})
    string(MAKE_C_IDENTIFIER ${folder} id)
    list(LENGTH in_${id} count)
    math(EXPR parts "(${count} + 8) / 9")
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE name)
    string(MAKE_C_IDENTIFIER ${name} name)
    set(i 0)
    foreach(source ${in_${id}})
      math(EXPR part "${i} * ${parts} / ${count}")
      math(EXPR i "${i} + 1")
      if(count GREATER 1)
        touchdown_unity_group(${target} ${name}_${part} ${source})
      endif()
    endforeach()
  endforeach()
endfunction()
# touchdown_unity_of_tests(<target> <source>...)
function(touchdown_unity_of_tests target)
  set_target_properties(${target} PROPERTIES TOUCHDOWN_IS_TEST ON)
  set(group 0)
  set(bytes 0)
  foreach(source ${ARGN})
    file(SIZE ${source} size)
    math(EXPR bytes "${bytes} + ${size}")
    if(bytes GREATER 80000)
      math(EXPR group "${group} + 1")
      set(bytes ${size})
    endif()
    touchdown_unity_group(${target} ${target}_${group} ${source})
  endforeach()
endfunction()
function(touchdown_unity_group target group source)
  if(TOUCHDOWN_UNITY AND NOT TOUCHDOWN_ESTIMATOR_ONLY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endif()
endfunction()

# touchdown_library(<name> FOLDERS <folder>... DEPENDS <target>...)
# makes the static library touchdown_<name>, with the alias touchdown::<name>, of every .cpp in the given
# folders below this one; without FOLDERS, of every .cpp in this one. PRECOMPILED: the owner of its
# precompiled headers. ONE_BY_ONE: its sources are not compiled together. COMPUTES: it is compiled with
# the full -O3.
function(touchdown_library name)
  cmake_parse_arguments(ARG "ONE_BY_ONE;COMPUTES" "PRECOMPILED" "FOLDERS;SOURCES;DEPENDS" ${ARGN})
  if(ARG_COMPUTES AND NOT ARG_PRECOMPILED)
    set(ARG_PRECOMPILED touchdown_computing_precompiled)
  endif()
  touchdown_sources(sources "${ARG_FOLDERS}")
  add_library(touchdown_${name} STATIC ${sources} ${ARG_SOURCES})
  add_library(touchdown::${name} ALIAS touchdown_${name})
  target_link_libraries(touchdown_${name} PUBLIC ${ARG_DEPENDS} PRIVATE $<BUILD_INTERFACE:touchdown_flags>)
  target_include_directories(touchdown_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  touchdown_precompile(touchdown_${name} ${ARG_PRECOMPILED})
  if(NOT ARG_COMPUTES)
    touchdown_optimize_less(touchdown_${name})
  endif()
  if(NOT ARG_ONE_BY_ONE)
    touchdown_unity(touchdown_${name} ${sources})
  endif()
endfunction()

# touchdown_program(<name> <source> <target>...)
# makes a program with a command line of its own beside `touchdown`, linked to these targets.
function(touchdown_program name source)
  find_package(CLI11 REQUIRED)
  add_executable(${name} ${source})
  touchdown_precompile(${name})
  touchdown_optimize_less(${name})
  target_link_libraries(${name} PRIVATE touchdown_flags ${ARGN} CLI11::CLI11)
  touchdown_check_before_main(${name})
  install(TARGETS ${name} RUNTIME)
endfunction()

# Adds apps/before_main.cpp, which must run on every processor and under every sanitizer.
# touchdown_check_before_main(<program>)
function(touchdown_check_before_main name)
  set(source ${PROJECT_SOURCE_DIR}/apps/before_main.cpp)
  target_sources(${name} PRIVATE ${source})
  set_source_files_properties(${source} TARGET_DIRECTORY ${name} PROPERTIES
    SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set_property(SOURCE ${source} TARGET_DIRECTORY ${name} PROPERTY
      COMPILE_OPTIONS -march=x86-64 -fno-sanitize=all)
    if(TOUCHDOWN_NATIVE AND TOUCHDOWN_HOST_IS_X86_64_V3)
      set_property(SOURCE ${source} TARGET_DIRECTORY ${name} PROPERTY
        COMPILE_DEFINITIONS TOUCHDOWN_NEEDS_AVX2)
    endif()
  endif()
endfunction()

# Lists every .cpp of the folders. Each build lists them again, so a new file needs no line anywhere.
function(touchdown_sources result folders)
  if(NOT folders)
    set(folders .)
  endif()
  list(TRANSFORM folders APPEND /*.cpp)
  file(GLOB sources CONFIGURE_DEPENDS ${folders})
  set(${result} ${sources} PARENT_SCOPE)
endfunction()

set(TOUCHDOWN_REFERENCE_DATA ${PROJECT_SOURCE_DIR}/../shared/data CACHE PATH
    "Folder of the paper's reference data; tests that need it are skipped without it")

# touchdown_optimize_tests_less(<target>)
# With -O1 g++ 12 reports false memory overruns where strings of known length are concatenated.
function(touchdown_optimize_tests_less target)
  touchdown_optimize_less(${target})
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
endfunction()

# touchdown_test(<folder> DEPENDS <target>...)
# makes the program test_<folder> of every .cpp below this folder, and the CTest tests of its suites.
# NIGHTLY: they run in `make nightly` alone.
function(touchdown_test folder)
  cmake_parse_arguments(ARG "NIGHTLY" "" "DEPENDS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  add_executable(test_${folder} ${sources})
  target_link_libraries(test_${folder} PRIVATE touchdown_flags ${ARG_DEPENDS} GTest::gmock GTest::gtest_main)
  touchdown_precompile(test_${folder} touchdown_tests_precompiled)
  touchdown_optimize_tests_less(test_${folder})
  touchdown_unity_of_tests(test_${folder} ${sources})
  target_compile_definitions(test_${folder} PRIVATE
    TOUCHDOWN_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    TOUCHDOWN_REFERENCE_DATA="${TOUCHDOWN_REFERENCE_DATA}")
  set(labels "")
  if(ARG_NIGHTLY)
    set(labels LABELS nightly)
  endif()
  touchdown_add_suites(test_${folder} ${folder} ${labels})
endfunction()

# touchdown_add_suites(<program> <prefix> [<property> <value>]...)
# makes one CTest test `prefix.Suite` of every suite of a test program. The tests of a suite share a
# process, with all values of their parameters, so that what they share is made once. `make nightly` runs
# the whole program in one process, in random order, so that no test depends on another. A test's time
# limit is ten times what it needs on a quiet machine: it ends what hangs, and checks nothing.
function(touchdown_add_suites program prefix)
  if(CMAKE_CROSSCOMPILING) # the program cannot list its tests here
    return()
  endif()
  set(properties TIMEOUT 600 ${ARGN}
    # For the sanitizers of the asan preset only.
    ENVIRONMENT "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/scripts/cmake/lsan.supp:print_suppressions=0"
    ENVIRONMENT_MODIFICATION "UBSAN_OPTIONS=set:print_stacktrace=1")
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${program}_suites.cmake)
  add_custom_command(TARGET ${program} POST_BUILD BYPRODUCTS ${suites}
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${program}> -DFILE=${suites}
            -P ${PROJECT_SOURCE_DIR}/scripts/cmake/ListSuites.cmake)
  # CTest runs this before it lists its tests.
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${program}_tests.cmake @ONLY CONTENT [[
set(properties [=[@properties@]=])
set(suites IsNotBuilt)
include("@suites@" OPTIONAL)
foreach(suite IN LISTS suites)
  add_test("@prefix@.${suite}" "@CMAKE_RUNTIME_OUTPUT_DIRECTORY@/@program@" "--gtest_filter=${suite}.*:*/${suite}.*")
  set_tests_properties("@prefix@.${suite}" PROPERTIES ${properties})
endforeach()
]])
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${program}_tests.cmake)
  if(TOUCHDOWN_NIGHTLY AND NOT ARGN MATCHES nightly)
    add_test(NAME ${prefix}.InAnyOrder COMMAND ${program} --gtest_shuffle)
    set_tests_properties(${prefix}.InAnyOrder PROPERTIES ${properties} TIMEOUT 3600 LABELS nightly)
  endif()
endfunction()

# touchdown_install_data(<folder> <argument of install>...)
# installs the robots, scenarios, sensor profiles, experiments, fitted models and examples of mappings
# below the folder.
function(touchdown_install_data destination)
  foreach(folder models scenarios noise experiments examples/mapping)
    set(patterns xml urdf yaml npz json csv)
    list(TRANSFORM patterns PREPEND ${PROJECT_SOURCE_DIR}/${folder}/*.)
    file(GLOB_RECURSE files CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${patterns})
    foreach(file ${files})
      cmake_path(GET file PARENT_PATH within)
      install(FILES ${PROJECT_SOURCE_DIR}/${file} DESTINATION ${destination}/${within} ${ARGN})
    endforeach()
  endforeach()
endfunction()
