# Writes TO, a source file with the commit of the tree SOURCE, if that has changed: cmake -DSOURCE=... -DTO=... -P this
set(hash "")
if(EXISTS ${SOURCE}/.git)
  execute_process(COMMAND git describe --always --abbrev=12 --exclude=* --dirty=+ WORKING_DIRECTORY ${SOURCE}
                  OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE problem)
  if(NOT problem EQUAL 0)
    set(hash "") # no git, or a tree of another user
  endif()
endif()
file(CONFIGURE OUTPUT ${TO} CONTENT [[
#include "commit_hash.h"

const char* const molsurf::tool::commitHash = "@hash@";
]] @ONLY)
