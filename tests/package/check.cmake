# Installs the library into an empty folder, builds the consumer against it, and runs it and the
# installed tool.
#     cmake -DBUILD=<build folder> -DSOURCE=<this folder> -DWORK=<folder to use> -DPYTHON=<Python> -DCXX=<compiler> -P check.cmake
# Then looks for what README.md says is installed, and for files that the installed pages name.
set(prefix ${WORK}/prefix)
set(consumer ${WORK}/consumer)
file(REMOVE_RECURSE ${WORK})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${consumer} -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${consumer})
run(${consumer}/consumer ${WORK}/two_atoms.ply)
set(crambin ${SOURCE}/../data/1crn.pdb)
run(${consumer}/coloured ${crambin} ${WORK}/crambin.glb ${WORK}/crambin.vdb)
run(${consumer}/residues ${crambin})
run(${consumer}/compared ${crambin} ${WORK}/crambin.json)
# The same object, linked as pkg-config says.
file(GLOB_RECURSE object ${consumer}/*consumer.cpp.o)
file(GLOB_RECURSE pc ${prefix}/lib/*molsurf.pc)
cmake_path(GET pc PARENT_PATH pc)
run(sh -c "PKG_CONFIG_PATH='${pc}' pkg-config --cflags --libs --static 'molsurf >= 1.0' > '${WORK}/flags'")
file(READ ${WORK}/flags flags)
separate_arguments(flags UNIX_COMMAND "${flags}")
run(${CXX} ${object} -o ${WORK}/by_pkg_config ${flags})
run(${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${pc}/.. ${WORK}/by_pkg_config ${WORK}/two_atoms.ply)
run(${prefix}/bin/vdb_molsurf --version)
run(${prefix}/bin/vdb_molsurf_msms --version)
run(${PYTHON} -B ${SOURCE}/../../scripts/check_docs.py --installed ${prefix}/share/doc/vdb_molsurf)
file(READ ${SOURCE}/../../docs/install.md guide)
foreach(named man/man1/vdb_molsurf.1 man/man1/vdb_molsurf_msms.1 bash-completion/completions/vdb_molsurf
        zsh/site-functions/_vdb_molsurf fish/vendor_completions.d/vdb_molsurf.fish)
  cmake_path(GET named PARENT_PATH folder)
  string(REPLACE "/man1" "" folder ${folder})
  if(NOT EXISTS ${prefix}/share/${named} OR NOT guide MATCHES "PREFIX/share/${folder}")
    message(FATAL_ERROR "share/${named} is not installed, or the guide does not say where it is")
  endif()
endforeach()
