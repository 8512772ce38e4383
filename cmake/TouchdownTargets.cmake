# How every folder of the project becomes a target: the same standard, warnings and include root.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

# Warnings are errors for us; `cmake --compile-no-warning-as-error` is for other people's compilers.
if(NOT DEFINED CMAKE_COMPILE_WARNING_AS_ERROR)
  set(CMAKE_COMPILE_WARNING_AS_ERROR ON)
endif()

# g++ 12 asks the processor for the whole level; a compiler that cannot ask, or another
# architecture, fails to compile this and gets the portable code.
include(CheckCXXSourceRuns)
check_cxx_source_runs(
  "int main() { return __builtin_cpu_supports(\"x86-64-v3\") ? 0 : 1; }"
  TOUCHDOWN_HOST_IS_X86_64_V3)

# Flags of all our own code; they stay in this build tree and are never installed.
# `-fno-math-errno` lets square roots vectorise.
add_library(touchdown_flags INTERFACE)
target_compile_options(touchdown_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -fno-math-errno
  $<$<AND:$<BOOL:${TOUCHDOWN_NATIVE}>,$<BOOL:${TOUCHDOWN_HOST_IS_X86_64_V3}>>:-march=x86-64-v3>)
target_include_directories(touchdown_flags INTERFACE ${PROJECT_SOURCE_DIR})

# touchdown_library(<folder> SOURCES <file>... DEPENDS <target>...)
# makes the static library touchdown_<folder>, known as touchdown::<folder>.
function(touchdown_library folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(touchdown_${folder} STATIC ${ARG_SOURCES})
  add_library(touchdown::${folder} ALIAS touchdown_${folder})
  target_link_libraries(touchdown_${folder} PUBLIC ${ARG_DEPENDS} PRIVATE $<BUILD_INTERFACE:touchdown_flags>)
  target_include_directories(touchdown_${folder} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
endfunction()

set(TOUCHDOWN_REFERENCE_DATA ${PROJECT_SOURCE_DIR}/../shared/data CACHE PATH
    "Where the paper's reference data is; tests that need it are skipped where it is not")

# touchdown_test(<folder> SOURCES <file>... DEPENDS <target>...)
# makes the program test_<folder>; every TEST in it becomes one CTest test.
function(touchdown_test folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(test_${folder} ${ARG_SOURCES})
  target_link_libraries(test_${folder} PRIVATE touchdown_flags ${ARG_DEPENDS} GTest::gmock GTest::gtest_main)
  target_compile_definitions(test_${folder} PRIVATE
    TOUCHDOWN_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    TOUCHDOWN_REFERENCE_DATA="${TOUCHDOWN_REFERENCE_DATA}")
  gtest_discover_tests(test_${folder} TEST_PREFIX ${folder}. DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT 300
                       # Read by the sanitizers of the asan preset, by nothing else.
                       ENVIRONMENT "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/lsan.supp:print_suppressions=0"
                       ENVIRONMENT_MODIFICATION "UBSAN_OPTIONS=set:print_stacktrace=1")
endfunction()
