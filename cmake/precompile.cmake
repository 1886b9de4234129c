# Most of the compiler's time goes to OpenVDB. molsurf_precompile(<target> [<header>...]) has its headers read once for a
# target, which has to link the library or be it; -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without.
set(molsurf_precompiled ${CMAKE_CURRENT_LIST_DIR}/precompiled)

function(molsurf_precompile target)
  target_precompile_headers(${target} PRIVATE ${molsurf_precompiled}/precompiled.h ${ARGN})
  if(target STREQUAL molsurf_internal AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_sources(molsurf_internal PRIVATE ${molsurf_precompiled}/float_grid.cpp ${molsurf_precompiled}/int32_grid.cpp
                                   ${molsurf_precompiled}/vec3s_grid.cpp)
  endif()
endfunction()
