# The SAT solver CaDiCaL, which comes without a package file of its own, as exemplar::cadical.

find_path(CADICAL_INCLUDE_DIR cadical.hpp)
find_library(CADICAL_LIBRARY cadical)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CaDiCaL
  REQUIRED_VARS CADICAL_LIBRARY CADICAL_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "it is in the package libcadical-dev")
if(CaDiCaL_FOUND AND NOT TARGET exemplar::cadical)
  add_library(exemplar::cadical UNKNOWN IMPORTED)
  set_target_properties(exemplar::cadical PROPERTIES
    IMPORTED_LOCATION ${CADICAL_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${CADICAL_INCLUDE_DIR})
endif()
