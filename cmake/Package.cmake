# What packages hold beside what is installed anyway, and how CPack makes them: `exemplar` (command,
# scenes, add-on, man pages, completions), `libexemplar-dev` (libraries, headers, CMake package) and
# `python3-exemplar`, as .deb. scripts/package.sh builds and checks them.

find_program(EXEMPLAR_HELP2MAN help2man REQUIRED)
# It is run here where the scenes that it names are not installed yet.
set(with_scenes ${CMAKE_COMMAND} -E env EXEMPLAR_SCENES=${PROJECT_SOURCE_DIR}/scenes)
set(folder ${PROJECT_BINARY_DIR}/package)
file(MAKE_DIRECTORY ${folder})

# Man pages: of the command, and of each of its subcommands as `exemplar-synth`.
set(subcommands synth sdf mesh render measure scene voxelize info compare engines completion world)
foreach(subcommand IN ITEMS "" ${subcommands})
  string(REGEX REPLACE "^(.+)$" "-\\1" dashed "${subcommand}")
  set(page ${folder}/exemplar${dashed}.1)
  add_custom_command(OUTPUT ${page}.gz
    COMMAND ${with_scenes} sh ${PROJECT_SOURCE_DIR}/cmake/man_page.sh $<TARGET_FILE:exemplar> ${page} ${PROJECT_VERSION} ${subcommand}
    DEPENDS exemplar ${PROJECT_SOURCE_DIR}/cmake/man_page.sh VERBATIM)
  list(APPEND pages ${page}.gz)
endforeach()

foreach(shell bash zsh fish)
  add_custom_command(OUTPUT ${folder}/completion.${shell}
    COMMAND ${with_scenes} $<TARGET_FILE:exemplar> completion ${shell} > ${folder}/completion.${shell}
    DEPENDS exemplar VERBATIM)
  list(APPEND scripts ${folder}/completion.${shell})
endforeach()
add_custom_target(exemplar_package_pages ALL DEPENDS ${pages} ${scripts})

install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
install(FILES ${folder}/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME exemplar COMPONENT command)
install(FILES ${folder}/completion.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
        RENAME _exemplar COMPONENT command)
install(FILES ${folder}/completion.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
        RENAME exemplar.fish COMPONENT command)

# Packages and licenses that the command is made with.
add_custom_command(OUTPUT ${folder}/THIRD_PARTY.md ${folder}/exemplar.spdx
  COMMAND ${EXEMPLAR_PYTHON3} ${PROJECT_SOURCE_DIR}/scripts/third_party.py $<TARGET_FILE:exemplar> ${folder}
  DEPENDS exemplar ${PROJECT_SOURCE_DIR}/scripts/third_party.py VERBATIM)
add_custom_target(exemplar_third_party ALL DEPENDS ${folder}/THIRD_PARTY.md)
install(FILES ${folder}/THIRD_PARTY.md ${folder}/exemplar.spdx DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT command)

# Debian wants the license and what changed with each package.
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(${PROJECT_SOURCE_DIR}/cmake/debian/copyright ${folder}/copyright COPYONLY)
foreach(component command development python)
  set(package_command exemplar)
  set(package_development libexemplar-dev)
  set(package_python python3-exemplar)
  set(package ${package_${component}})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/debian/changelog.in ${folder}/${package}.changelog @ONLY)
  add_custom_command(OUTPUT ${folder}/${package}.changelog.gz
    COMMAND gzip -9nc ${folder}/${package}.changelog > ${folder}/${package}.changelog.gz
    DEPENDS ${folder}/${package}.changelog VERBATIM)
  list(APPEND changelogs ${folder}/${package}.changelog.gz)
  install(FILES ${folder}/copyright DESTINATION share/doc/${package} COMPONENT ${component})
  install(FILES ${folder}/${package}.changelog.gz DESTINATION share/doc/${package}
          RENAME changelog.gz COMPONENT ${component})
endforeach()
add_custom_target(exemplar_changelogs ALL DEPENDS ${changelogs})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME exemplar)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The exemplar authors <exemplar@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL command development)
if(TARGET exemplar_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME exemplar)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_COMMAND_DESCRIPTION "more of one example mesh, map or label grid
 Synthesizes new geometry that looks like an example: larger, different
 everywhere, seamless, with the example's materials.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libexemplar-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libtbb-dev, libopenvdb-dev, libboost-iostreams-dev, libembree-dev, libopenmesh-dev, libhwy-dev, libmeshoptimizer-dev, libpng-dev, libjpeg-dev, libtiff-dev, libopenexr-dev, zlib1g-dev, libcadical-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "more of one example, for C++ programs
 The static libraries, headers and CMake package of exemplar.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-exemplar)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-distributed)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "more of one example, for Python
 The module exemplar: examples, requests, results and measures.")
include(CPack)
