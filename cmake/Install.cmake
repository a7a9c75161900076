# What `cmake --install` puts where: the command, the bundled scenes, and for C++ programs the rooms'
# libraries and headers with the package `exemplar`:
#
#     find_package(exemplar 0.1 REQUIRED)
#     target_link_libraries(mine PRIVATE exemplar::exemplar)    # or single rooms: exemplar::synth
#
# and in its sources #include <exemplar/synth/...>.
#
# tests/consumer is such a program.

include(CMakePackageConfigHelpers)
set(exemplar_package ${CMAKE_INSTALL_LIBDIR}/cmake/exemplar)

get_property(exemplar_libraries GLOBAL PROPERTY EXEMPLAR_LIBRARIES)
list(TRANSFORM exemplar_libraries PREPEND exemplar_)
add_library(exemplar_all_rooms INTERFACE)
add_library(exemplar::exemplar ALIAS exemplar_all_rooms)
set_target_properties(exemplar_all_rooms PROPERTIES EXPORT_NAME exemplar)
target_link_libraries(exemplar_all_rooms INTERFACE ${exemplar_libraries})
install(TARGETS exemplar_all_rooms ${exemplar_libraries} EXPORT exemplarTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT exemplarTargets NAMESPACE exemplar:: DESTINATION ${exemplar_package}
        COMPONENT development)

# Headers keep their rooms: <exemplar/sdf/mesh_to_sdf.h>. In the repository they include each other
# from its root; what is installed says <exemplar/...> there too, and needs nothing but include/.
foreach(room IN LISTS EXEMPLAR_ROOMS)
  install(CODE "
    execute_process(
      COMMAND \"${CMAKE_COMMAND}\" -DSOURCE=${PROJECT_SOURCE_DIR} -DROOM=${room}
              \"-DROOMS=${EXEMPLAR_ROOMS}\" -DOUT=${PROJECT_BINARY_DIR}/installed_headers
              -P ${PROJECT_SOURCE_DIR}/cmake/RewriteIncludes.cmake
      COMMAND_ERROR_IS_FATAL ANY)" COMPONENT development)
endforeach()
install(DIRECTORY ${PROJECT_BINARY_DIR}/installed_headers/
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/exemplar COMPONENT development
        FILES_MATCHING PATTERN "*.h")

configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/exemplarConfig.cmake.in
  ${PROJECT_BINARY_DIR}/exemplarConfig.cmake INSTALL_DESTINATION ${exemplar_package})
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/exemplarConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/exemplarConfig.cmake
              ${PROJECT_BINARY_DIR}/exemplarConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/LinkedPackages.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindCaDiCaL.cmake
        DESTINATION ${exemplar_package} COMPONENT development)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes/
        DESTINATION ${CMAKE_INSTALL_DATADIR}/exemplar/scenes COMPONENT command
        FILES_MATCHING PATTERN "*.toml")
install(PROGRAMS ${PROJECT_SOURCE_DIR}/scripts/world-dask.py
        DESTINATION ${CMAKE_INSTALL_DATADIR}/exemplar COMPONENT python)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/docs/measures.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command)
