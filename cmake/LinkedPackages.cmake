# The packages that exemplar's libraries are linked with, one list for the build itself
# (Dependencies.cmake) and, installed, for programs that use the libraries (exemplarConfig.cmake).
# Whoever includes this has set exemplar_libdir, the folder in which exemplar is or was to be
# installed.

# TBB comes first and by its own config package: OpenVDB's private FindTBB module would otherwise
# define a second TBB::tbb and stop the configuration.
set(exemplar_packages
  "TBB CONFIG"
  "OpenVDB COMPONENTS openvdb"
  "embree 3.13 CONFIG"
  "OpenMesh CONFIG"
  "hwy CONFIG"
  "meshoptimizer CONFIG"
  PNG JPEG TIFF "OpenEXR CONFIG" ZLIB CaDiCaL)

# OpenVDB ships a find module outside CMake's own path, and CaDiCaL's is beside this file. For
# these packages only: the other modules in those folders must shadow nothing.
set(exemplar_module_path ${CMAKE_CURRENT_LIST_DIR} ${exemplar_libdir}/cmake/OpenVDB
  /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
