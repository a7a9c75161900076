# Headers that nearly every source includes, parsed once for all of them: a tenth off the time that
# the libraries take to build, a fifth off that of the tests. Sources include what they use all the
# same, and every preset builds without it. With ccache it is better left off:
# what is precompiled in one folder is not found again by another.
option(EXEMPLAR_PRECOMPILE "Precompile the headers that nearly every source includes" OFF)
if(NOT EXEMPLAR_PRECOMPILE)
  # exemplar_precompile(<target> LIKE <precompiled>): takes the headers that <precompiled> has parsed.
  function(exemplar_precompile target)
  endfunction()
  return()
endif()

set(EXEMPLAR_COMMON_HEADERS
  <algorithm> <array> <bit> <charconv> <chrono> <cmath> <cstdint> <cstdio> <cstring> <filesystem> <functional> <limits>
  <map> <memory> <mutex> <numbers> <numeric> <optional> <set> <span> <sstream> <string> <string_view> <tuple>
  <unordered_map> <utility> <variant> <vector>)

# One parse for each way of compiling: the compiler takes headers only where its options are the same.
function(exemplar_precompiled name)
  cmake_parse_arguments(ARG "POSITION_INDEPENDENT" "" "HEADERS;LINK;OPTIONS" ${ARGN})
  set(source ${CMAKE_BINARY_DIR}/precompiled/${name}.cpp)
  if(NOT EXISTS ${source})
    file(WRITE ${source} "// What is precompiled belongs to a target, and a target has a source.\n")
  endif()
  add_library(${name} OBJECT ${source})
  target_compile_features(${name} PRIVATE cxx_std_20)
  set_target_properties(${name} PROPERTIES
    CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ${ARG_POSITION_INDEPENDENT})
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  target_link_libraries(${name} PRIVATE exemplar_build_options ${ARG_LINK})
  target_precompile_headers(${name} PRIVATE ${EXEMPLAR_COMMON_HEADERS} ${ARG_HEADERS})
endfunction()
exemplar_precompiled(exemplar_precompiled_library POSITION_INDEPENDENT)
# GCC loses sight of what is a system header's, and warns of what its optimizer made of it.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(exemplar_build_options INTERFACE -Wno-stringop-overflow -Wno-array-bounds)
endif()

function(exemplar_precompile target)
  cmake_parse_arguments(ARG "" "LIKE" "" ${ARGN})
  target_precompile_headers(${target} REUSE_FROM ${ARG_LIKE})
endfunction()
