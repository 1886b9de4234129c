# The OpenVDB of the programs and the tests, molsurf_openvdb: a static library made from the sources of Debian's package,
# or the system's. A process that loads Debian's libopenvdb.so spends 40 ms on the names of templates that it never
# calls; see docs/adr/0018-static-openvdb.md. -DFETCHCONTENT_SOURCE_DIR_OPENVDB=<folder> takes unpacked sources and no
# network.
set(molsurf_openvdb OpenVDB::openvdb)
# The library has the programs' object files, so both need the same version; a shared library has the programs' OpenVDB.
# Other build types are for debuggers and sanitizers.
if(MOLSURF_OPENVDB STREQUAL auto AND NOT
   (PROJECT_IS_TOP_LEVEL AND CMAKE_BUILD_TYPE STREQUAL Release AND NOT BUILD_SHARED_LIBS AND OpenVDB_VERSION VERSION_EQUAL 10.0.1))
  return()
elseif(MOLSURF_OPENVDB STREQUAL system)
  return()
endif()

set(openvdb_url http://deb.debian.org/debian/pool/main/o/openvdb/openvdb_10.0.1.orig.tar.xz)
set(openvdb_hash 776706ca285a43b53e24c28d8f8b2112aea3dbf94c3c5f399cf6ff43403f5ace)
set(openvdb_archive ${PROJECT_BINARY_DIR}/openvdb_10.0.1.orig.tar.xz)
if(NOT FETCHCONTENT_SOURCE_DIR_OPENVDB AND NOT EXISTS ${openvdb_archive})
  file(DOWNLOAD ${openvdb_url} ${openvdb_archive}.part INACTIVITY_TIMEOUT 15 TIMEOUT 120 STATUS openvdb_status)
  file(SHA256 ${openvdb_archive}.part openvdb_got)
  if(openvdb_got STREQUAL openvdb_hash)
    file(RENAME ${openvdb_archive}.part ${openvdb_archive})
  elseif(MOLSURF_OPENVDB STREQUAL static)
    message(FATAL_ERROR "${openvdb_url}: expected a file of SHA-256 ${openvdb_hash}, got ${openvdb_got} "
                        "(${openvdb_status}) [hint: -DMOLSURF_OPENVDB=system takes the system's OpenVDB]")
  else()
    message(STATUS "${openvdb_url} cannot be had (${openvdb_status}): the programs take the system's OpenVDB, and start in "
                   "40 ms, not in 4. -DMOLSURF_OPENVDB=auto tries again.")
    set_property(CACHE MOLSURF_OPENVDB PROPERTY VALUE system)
    return()
  endif()
endif()

include(FetchContent)
FetchContent_Declare(openvdb URL ${openvdb_archive} URL_HASH SHA256=${openvdb_hash})
FetchContent_GetProperties(openvdb)
if(NOT openvdb_POPULATED)
  FetchContent_Populate(openvdb) # without its CMakeLists.txt, which asks for more than we need
endif()
set(openvdb_headers ${openvdb_SOURCE_DIR}/openvdb)

# version.h holds the settings. These are Debian's, apart from explicit instantiation: its templates fill libopenvdb.so.
set(OpenVDB_MAJOR_VERSION 10)
set(OpenVDB_MINOR_VERSION 0)
set(OpenVDB_PATCH_VERSION 1)
set(OpenVDB_VERSION 10.0.1)
set(OPENVDB_ABI_VERSION_NUMBER 10)
math(EXPR OPENVDB_PACKED_VERSION "10 << 24 | 1")
set(OPENVDB_USE_BLOSC ON)
set(OPENVDB_USE_ZLIB ON)
set(OPENVDB_USE_IMATH_HALF ON)
set(OPENVDB_IMATH_VERSION ${Imath_VERSION})
set(OPENVDB_USE_DELAYED_LOADING ON)
configure_file(${openvdb_headers}/openvdb/version.h.in ${openvdb_BINARY_DIR}/openvdb/version.h)

find_library(BLOSC_LIBRARY blosc REQUIRED)
find_package(Threads REQUIRED)
file(GLOB openvdb_sources CONFIGURE_DEPENDS ${openvdb_headers}/openvdb/*.cc ${openvdb_headers}/openvdb/io/*.cc
     ${openvdb_headers}/openvdb/math/*.cc ${openvdb_headers}/openvdb/points/*.cc ${openvdb_headers}/openvdb/util/*.cc)
add_library(openvdb_static STATIC ${openvdb_sources})
set(molsurf_openvdb openvdb_static)
target_compile_features(openvdb_static PUBLIC cxx_std_17)
set_target_properties(openvdb_static PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_compile_definitions(openvdb_static PRIVATE OPENVDB_PRIVATE PUBLIC OPENVDB_STATICLIB OPENVDB_USE_DELAYED_LOADING)
target_include_directories(openvdb_static SYSTEM
  PUBLIC ${openvdb_BINARY_DIR} ${openvdb_BINARY_DIR}/openvdb ${openvdb_headers}) # and as "version.h"
target_link_libraries(openvdb_static
  PUBLIC Imath::Imath TBB::tbb Boost::iostreams Threads::Threads
  PRIVATE ZLIB::ZLIB ${BLOSC_LIBRARY})
