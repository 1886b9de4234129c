# Installs the libraries that the programs need beside them, but for those of the compiler and the C library, with what
# Debian's packages say of their licences: the tarball (docs/development/packages.md) runs where none of them is.
set(programs $<TARGET_FILE:vdb_molsurf> $<TARGET_FILE:vdb_molsurf_msms> $<TARGET_FILE:vdb_molsurf_nanoshaper>)
install(CODE "set(programs ${programs})
  set(libraries_folder ${CMAKE_INSTALL_LIBDIR})
  set(licences_script ${PROJECT_SOURCE_DIR}/scripts/licences.sh)
  set(licences \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/licenses/vdb_molsurf)")
install(CODE [[
  file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${programs} RESOLVED_DEPENDENCIES_VAR libraries
       PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread|gcc_s|stdc\\+\\+)\\.so")
  foreach(library IN LISTS libraries)
    file(INSTALL ${library} DESTINATION ${CMAKE_INSTALL_PREFIX}/${libraries_folder} TYPE SHARED_LIBRARY FOLLOW_SYMLINK_CHAIN)
    file(REAL_PATH ${library} library)
    list(APPEND files ${library})
  endforeach()
  execute_process(COMMAND ${licences_script} ${licences} ${files} COMMAND_ERROR_IS_FATAL ANY)]])
