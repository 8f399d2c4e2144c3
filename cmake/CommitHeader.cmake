# Writes a header that names the commit being built: run at every build as
#   cmake -D SOURCE=source folder -D HEADER=file -P CommitHeader.cmake
# The header changes only when the commit does, so that nothing is compiled again needlessly. A
# source tree that is no git repository of its own (an unpacked archive) is of an "unknown" commit.
set(commit "unknown")
find_package(Git QUIET)
if(GIT_FOUND AND EXISTS "${SOURCE}/.git")
  # A build that a git hook starts inherits variables that point elsewhere.
  set(git "${CMAKE_COMMAND}" -E env --unset=GIT_DIR --unset=GIT_WORK_TREE --unset=GIT_INDEX_FILE
          "${GIT_EXECUTABLE}" --no-optional-locks -C "${SOURCE}")
  execute_process(COMMAND ${git} rev-parse HEAD RESULT_VARIABLE status OUTPUT_VARIABLE head
                  ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  # What the program is built from, new files included: sources are globbed.
  execute_process(COMMAND ${git} status --porcelain -- src apps cmake CMakeLists.txt
                  OUTPUT_VARIABLE changes ERROR_QUIET)
  if(status EQUAL 0)
    set(commit "${head}")
    if(changes)
      string(APPEND commit "-dirty")
    endif()
  endif()
endif()

set(text "#pragma once\n#define SLAMBENCH_COMMIT \"${commit}\"\n")
set(old "")
if(EXISTS "${HEADER}")
  file(READ "${HEADER}" old)
endif()
if(NOT old STREQUAL text)
  file(WRITE "${HEADER}" "${text}")
endif()
