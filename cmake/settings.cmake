# How the library and the programs are compiled: molsurf_settings(<target>). All are compiled alike, since most of the
# compiler's time goes to OpenVDB, whose headers it then reads once for all of them;
# -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without.
set(molsurf_precompiled ${CMAKE_CURRENT_LIST_DIR}/precompiled)

# A unity build puts the constants of several files before the functions of each, so GCC looks there for local names
# that hide local ones only; -DMOLSURF_WERROR=ON, with each file by itself, looks for all (preset dev).
function(molsurf_settings target)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_compile_definitions(${target} PRIVATE MOLSURF_VERSION="${PROJECT_VERSION}")
  # Selects and square roots of the kernels vectorise only without errno and traps; NaN keeps its meaning.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wno-psabi $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>
                                           $<$<BOOL:${MOLSURF_WERROR}>:-Werror> $<$<BOOL:${MOLSURF_WERROR}>:-Wshadow>
                                           -fno-math-errno -fno-trapping-math)
  if(NOT target STREQUAL molsurf_kernel)
    target_precompile_headers(${target} REUSE_FROM molsurf_kernel)
    return()
  endif()
  target_precompile_headers(molsurf_kernel PRIVATE ${molsurf_precompiled}/precompiled.h)
  if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_sources(molsurf_kernel PRIVATE ${molsurf_precompiled}/float_grid.cpp ${molsurf_precompiled}/int32_grid.cpp
                                   ${molsurf_precompiled}/vec3s_grid.cpp)
  endif()
endfunction()
