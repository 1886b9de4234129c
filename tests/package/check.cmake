# Installs the library into an empty folder, builds the consumer against it, and runs it and the
# installed tool.
#     cmake -DBUILD=<build folder> -DSOURCE=<this folder> -DWORK=<folder to use> -P check.cmake
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
run(${prefix}/bin/vdb_molsurf --version)
run(${prefix}/bin/vdb_molsurf_msms --version)
