# How a room of the house and its tests are declared.

# What every source of ours is compiled with; never exported to users of the library.
add_library(exemplar_build_options INTERFACE)
target_compile_options(exemplar_build_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wno-missing-field-initializers
  # GCC 12 reports overlaps in std::string that cannot be (its bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${EXEMPLAR_WERROR}>:-Werror>
  # GCC 12 packs two doubles that go to float and back, and leaves them as they were.
  $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
  # Same input, same bytes: no fused multiply-add where the source has a product and a sum.
  -ffp-contract=off)
if(EXEMPLAR_SANITIZE)
  # Lines alone: sources that include OpenVDB take 3 GB of memory with all there is to say.
  add_compile_options(-fsanitize=${EXEMPLAR_SANITIZE} -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=${EXEMPLAR_SANITIZE})
  if(EXEMPLAR_SANITIZE MATCHES undefined)
    add_compile_options(-fno-sanitize-recover=undefined)
  endif()
endif()

# exemplar_library(<room> SOURCES <file>... [LINK <public target>...] [PRIVATE <target>...])
#
# Defines the library exemplar_<room> with the alias exemplar::<room>. Headers are included from
# the repository's root: "core/vec.h"; once installed, as <exemplar/core/vec.h>.
function(exemplar_library room)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE" ${ARGN})
  add_library(exemplar_${room} STATIC ${ARG_SOURCES})
  add_library(exemplar::${room} ALIAS exemplar_${room})
  target_compile_features(exemplar_${room} PUBLIC cxx_std_20)
  set_target_properties(exemplar_${room} PROPERTIES
    CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON EXPORT_NAME ${room})
  target_include_directories(exemplar_${room} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  # What is only headers is compiled in: programs that use the installed library do not need it.
  list(TRANSFORM ARG_PRIVATE REPLACE
    "^((nlohmann_json|Eigen3)::.+)$" "$<BUILD_INTERFACE:\\1>")
  target_link_libraries(exemplar_${room} PUBLIC ${ARG_LINK}
    PRIVATE $<BUILD_INTERFACE:exemplar_build_options> ${ARG_PRIVATE})
  exemplar_precompile(exemplar_${room} LIKE exemplar_precompiled_library)
  set_property(GLOBAL APPEND PROPERTY EXEMPLAR_LIBRARIES ${room})
endfunction()

# exemplar_test(<room> SOURCES <file>... LINK <target>...): one test program for a room.
function(exemplar_test room)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${room}_test ${ARG_SOURCES})
  set_target_properties(${room}_test PROPERTIES CXX_EXTENSIONS OFF)
  target_link_libraries(${room}_test PRIVATE ${ARG_LINK} exemplar_build_options
    GTest::gmock GTest::gtest_main)
  # A third of the time to build tests goes into making them fast; the work is in the libraries.
  target_compile_options(${room}_test PRIVATE $<$<CONFIG:Release>:-O1>)
  exemplar_precompile(${room}_test LIKE exemplar_precompiled_test)
  gtest_discover_tests(${room}_test DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 300)
endfunction()

# exemplar_bench(<name> SOURCES <file>... LINK <target>...): one benchmark program.
function(exemplar_bench name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name}_bench ${ARG_SOURCES})
  set_target_properties(${name}_bench PROPERTIES CXX_EXTENSIONS OFF)
  target_link_libraries(${name}_bench PRIVATE ${ARG_LINK} exemplar_build_options
    benchmark::benchmark_main)
endfunction()
