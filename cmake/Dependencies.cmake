# The libraries exemplar stands on, all from Debian 12's packages (scripts/install.sh names them).

include(GNUInstallDirs)

# TBB comes first and by its own config package: OpenVDB's private FindTBB module would otherwise
# define a second TBB::tbb and stop the configuration.
set(CMAKE_FIND_PACKAGE_PREFER_CONFIG ON)
find_package(TBB CONFIG REQUIRED)

# OpenVDB ships a find module outside CMake's own path; restore the path afterwards, so that the
# other modules in its folder shadow nothing.
set(exemplar_module_path ${CMAKE_MODULE_PATH})
list(APPEND CMAKE_MODULE_PATH ${CMAKE_INSTALL_FULL_LIBDIR}/cmake/OpenVDB
     /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
find_package(OpenVDB REQUIRED COMPONENTS openvdb)
set(CMAKE_MODULE_PATH ${exemplar_module_path})

find_package(embree 3.13 CONFIG REQUIRED)
find_package(OpenMesh CONFIG REQUIRED)
find_package(TinyGLTF CONFIG REQUIRED)
find_package(Eigen3 CONFIG REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(CLI11 REQUIRED)

# CaDiCaL comes without a package file of its own.
find_path(CADICAL_INCLUDE_DIR cadical.hpp REQUIRED)
find_library(CADICAL_LIBRARY cadical REQUIRED)
if(NOT TARGET exemplar::cadical)
  add_library(exemplar::cadical UNKNOWN IMPORTED)
  set_target_properties(exemplar::cadical PROPERTIES
    IMPORTED_LOCATION ${CADICAL_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${CADICAL_INCLUDE_DIR})
endif()
