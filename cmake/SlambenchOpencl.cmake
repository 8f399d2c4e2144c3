# Whether the backend `opencl` is built: whenever the headers and the loader of OpenCL are there; sets
# SLAMBENCH_HAS_OPENCL. Drivers bring threads of their own that ThreadSanitizer does not see into:
# its builds do without.
option(SLAMBENCH_OPENCL "Build the backend opencl where there are OpenCL's headers and loader" ON)
set(SLAMBENCH_HAS_OPENCL OFF)
if(SLAMBENCH_OPENCL AND NOT SLAMBENCH_SANITIZE MATCHES "thread")
  find_package(OpenCL QUIET)
  find_file(OPENCL_HPP CL/opencl.hpp HINTS ${OpenCL_INCLUDE_DIRS})
  if(OpenCL_FOUND AND OPENCL_HPP AND xxhash_FOUND)
    set(SLAMBENCH_HAS_OPENCL ON)
  endif()
endif()
