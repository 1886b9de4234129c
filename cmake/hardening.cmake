# What an optimised build has against errors in memory: addresses of functions that cannot be overwritten, a mark behind
# arrays on the stack, bounds in the functions of the C library. All targets have it, a static OpenVDB and the Python
# module too. Flags of a distribution win; builds with debug information are for sanitizers, which look for more.
set(molsurf_hardened $<CONFIG:Release,MinSizeRel>)
add_compile_options($<${molsurf_hardened}:-fstack-protector-strong>)
if(NOT CMAKE_CXX_FLAGS MATCHES "_FORTIFY_SOURCE")
  add_compile_options($<${molsurf_hardened}:-U_FORTIFY_SOURCE> $<${molsurf_hardened}:-D_FORTIFY_SOURCE=2>)
endif()
add_link_options($<${molsurf_hardened}:LINKER:-z,relro> $<${molsurf_hardened}:LINKER:-z,now>)
