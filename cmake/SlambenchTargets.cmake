# What every target of the project shares.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
string(REPLACE "-DNDEBUG" "" CMAKE_CXX_FLAGS_RELEASE "-O3")

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE}")
endif()

set(SLAMBENCH_SANITIZE "" CACHE STRING "Sanitizers, as for -fsanitize=")
option(SLAMBENCH_WERROR "Treat warnings as errors" OFF)

add_library(slambench_options INTERFACE)
target_include_directories(slambench_options INTERFACE "${PROJECT_SOURCE_DIR}/src")
target_compile_options(slambench_options INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow>
  # Nothing here reads errno after a maths call or traps; and a*b+c is rounded as written, so
  # that a trajectory does not depend on the compiler's choice of fused instructions.
  $<$<COMPILE_LANGUAGE:CXX>:-fno-math-errno -fno-trapping-math -ffp-contract=off>
  # GCC 12 sees an overflow inside fmt that is not there.
  $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-stringop-overflow>
  $<$<AND:$<BOOL:${SLAMBENCH_WERROR}>,$<COMPILE_LANGUAGE:CXX>>:-Werror>)
if(SLAMBENCH_SANITIZE)
  target_compile_options(slambench_options INTERFACE
    -fsanitize=${SLAMBENCH_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(slambench_options INTERFACE -fsanitize=${SLAMBENCH_SANITIZE})
endif()

# slambench_library(NAME folder...): the library of this folder, made of all its sources, that may
# include the given folders of src/.
function(slambench_library name)
  file(GLOB sources CONFIGURE_DEPENDS "*.cpp")
  string(REPLACE "/" "_" target "slambench_${name}")
  list(TRANSFORM ARGN PREPEND "slambench_")
  string(REPLACE "/" "_" dependencies "${ARGN}")
  if(sources)
    add_library(${target} STATIC ${sources})
    target_link_libraries(${target} PUBLIC slambench_options ${dependencies})
  else()
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE slambench_options ${dependencies})
  endif()
endfunction()

# slambench_test(NAME folder...): one test program of all *_test.cpp of this folder.
function(slambench_test name)
  file(GLOB sources CONFIGURE_DEPENDS "*.cpp")
  list(TRANSFORM ARGN PREPEND "slambench_")
  string(REPLACE "/" "_" dependencies "${ARGN}")
  add_executable(${name}_tests ${sources})
  target_include_directories(${name}_tests PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_link_libraries(${name}_tests PRIVATE slambench_options ${dependencies}
                                              GTest::gmock GTest::gtest_main)
  # Tests share the cores: a thread that has nothing to do shall not keep one busy. Drivers of
  # OpenCL leak.
  gtest_discover_tests(${name}_tests TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT 600 ENVIRONMENT OMP_WAIT_POLICY=passive
    ENVIRONMENT_MODIFICATION
    "LSAN_OPTIONS=set:suppressions=${PROJECT_SOURCE_DIR}/tests/lsan.supp:print_suppressions=0")
endfunction()
