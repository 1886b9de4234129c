# OpenVDB as a static library, made from the sources of Debian's package: the target OpenVDB::openvdb. A process that
# loads Debian's libopenvdb.so spends 40 ms on the names of templates that it never calls; see
# docs/adr/0018-static-openvdb.md. -DFETCHCONTENT_SOURCE_DIR_OPENVDB=<folder> takes unpacked sources and no network.
include(FetchContent)
FetchContent_Declare(openvdb
  URL http://deb.debian.org/debian/pool/main/o/openvdb/openvdb_10.0.1.orig.tar.xz
  URL_HASH SHA256=776706ca285a43b53e24c28d8f8b2112aea3dbf94c3c5f399cf6ff43403f5ace)
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
add_library(OpenVDB::openvdb ALIAS openvdb_static)
target_compile_features(openvdb_static PUBLIC cxx_std_17)
set_target_properties(openvdb_static PROPERTIES POSITION_INDEPENDENT_CODE ${BUILD_SHARED_LIBS})
target_compile_definitions(openvdb_static PRIVATE OPENVDB_PRIVATE PUBLIC OPENVDB_STATICLIB OPENVDB_USE_DELAYED_LOADING)
target_include_directories(openvdb_static SYSTEM
  PUBLIC ${openvdb_BINARY_DIR} ${openvdb_BINARY_DIR}/openvdb ${openvdb_headers}) # and as "version.h"
target_link_libraries(openvdb_static
  PUBLIC Imath::Imath TBB::tbb Boost::iostreams Threads::Threads
  PRIVATE ZLIB::ZLIB ${BLOSC_LIBRARY})
