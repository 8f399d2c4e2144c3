# Whether the backend `cuda` is built, and for which devices. It is built whenever there is a CUDA
# compiler that works with the host's; sets SLAMBENCH_HAS_CUDA. Sanitizers of the host do not go
# through it: their builds have no device code, but all tests of it that run on the host.
option(SLAMBENCH_CUDA "Build the backend cuda where there is a CUDA compiler" ON)
option(SLAMBENCH_CUDA_FMAD
       "Let the device fuse multiplications and additions: quicker, and other bits than serial" OFF)
set(SLAMBENCH_CUDA_ARCHITECTURES "" CACHE STRING
    "As CMAKE_CUDA_ARCHITECTURES, 75 and later; empty: that of the GPU here, or 75-virtual;90-real")

set(SLAMBENCH_HAS_CUDA OFF)
if(SLAMBENCH_CUDA AND NOT SLAMBENCH_SANITIZE)
  if(NOT CMAKE_CUDA_COMPILER AND NOT DEFINED ENV{CUDACXX})
    find_program(SLAMBENCH_NVCC nvcc HINTS ENV CUDA_PATH ENV CUDA_HOME
                 PATHS /usr/local/cuda PATH_SUFFIXES bin)
    if(SLAMBENCH_NVCC)
      set(CMAKE_CUDA_COMPILER "${SLAMBENCH_NVCC}")
    endif()
  endif()
  if(NOT DEFINED CMAKE_CUDA_HOST_COMPILER AND NOT DEFINED ENV{CUDAHOSTCXX})
    set(CMAKE_CUDA_HOST_COMPILER "${CMAKE_CXX_COMPILER}")
  endif()
  include(CheckLanguage)
  check_language(CUDA)
  if(CMAKE_CUDA_COMPILER)
    enable_language(CUDA)
    find_package(CUDAToolkit QUIET)
    if(CUDAToolkit_FOUND AND CMAKE_CUDA_COMPILER_VERSION VERSION_GREATER_EQUAL 12)
      set(SLAMBENCH_HAS_CUDA ON)
    endif()
  endif()
endif()

if(SLAMBENCH_HAS_CUDA)
  if(NOT CMAKE_CUDA20_STANDARD_COMPILE_OPTION) # CMake 3.25 does not know that nvcc knows C++20
    set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION "-std=c++20")
  endif()
  set(CMAKE_CUDA_STANDARD 20)
  set(CMAKE_CUDA_STANDARD_REQUIRED ON)
  set(CMAKE_CUDA_EXTENSIONS OFF)
  string(REPLACE "-DNDEBUG" "" CMAKE_CUDA_FLAGS_RELEASE "-O3")
  if(CCACHE AND NOT CMAKE_CUDA_COMPILER_LAUNCHER)
    set(CMAKE_CUDA_COMPILER_LAUNCHER "${CCACHE}")
  endif()
  set(architectures "${SLAMBENCH_CUDA_ARCHITECTURES}")
  # Without a GPU this is empty, or, by later versions of CMake, a sentence that says so.
  if(NOT architectures AND CMAKE_CUDA_ARCHITECTURES_NATIVE MATCHES "^[0-9]")
    set(architectures "${CMAKE_CUDA_ARCHITECTURES_NATIVE}")
  endif()
  if(NOT architectures)
    set(architectures 75-virtual 90-real)
  endif()
  set(SLAMBENCH_CUDA_TARGETS "${architectures}")
  message(STATUS "CUDA ${CMAKE_CUDA_COMPILER_VERSION} for ${SLAMBENCH_CUDA_TARGETS}")
endif()
