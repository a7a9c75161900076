# What the page of a report is made of: the sources in web/ and, bundled with three.js from npm, what
# shows surfaces that turn. Sets EXEMPLAR_REPORT_BUNDLES to whether that is there; where npm or its
# registry is not, pages show pictures in its place.

set(EXEMPLAR_REPORT_3D AUTO CACHE STRING
    "Surfaces that turn in reports: AUTO (where npm can get three.js), ON (or fail), OFF (pictures)")
set_property(CACHE EXEMPLAR_REPORT_3D PROPERTY STRINGS AUTO ON OFF)

set(exemplar_web ${PROJECT_SOURCE_DIR}/web)
set(exemplar_web_build ${PROJECT_BINARY_DIR}/web)
set(EXEMPLAR_WEB_MODULES ${exemplar_web_build}/node_modules)

# Installs the packages that web/package-lock.json pins, once for each version of it. Sets `why` where
# that does not work.
function(exemplar_web_packages why)
  set(${why} "" PARENT_SCOPE)
  find_program(EXEMPLAR_NODE NAMES node nodejs)
  find_program(EXEMPLAR_NPM npm)
  mark_as_advanced(EXEMPLAR_NODE EXEMPLAR_NPM)
  if(NOT EXEMPLAR_NODE OR NOT EXEMPLAR_NPM)
    set(${why} "node and npm are not installed" PARENT_SCOPE)
    return()
  endif()
  file(SHA256 ${exemplar_web}/package-lock.json lock)
  set(stamp ${exemplar_web_build}/installed.txt)
  if(EXISTS ${stamp})
    file(READ ${stamp} installed)
    if(installed STREQUAL lock)
      return()
    endif()
  endif()
  message(STATUS "Getting three.js and esbuild from npm")
  file(MAKE_DIRECTORY ${exemplar_web_build})
  configure_file(${exemplar_web}/package.json ${exemplar_web_build}/package.json COPYONLY)
  configure_file(${exemplar_web}/package-lock.json ${exemplar_web_build}/package-lock.json COPYONLY)
  # No package's own scripts are run, and a registry that is not there is given up soon.
  execute_process(
    COMMAND ${EXEMPLAR_NPM} ci --ignore-scripts --no-audit --no-fund --fetch-retries=1
            --fetch-retry-mintimeout=1000 --fetch-timeout=60000
    WORKING_DIRECTORY ${exemplar_web_build} TIMEOUT 300
    RESULT_VARIABLE result OUTPUT_VARIABLE log ERROR_VARIABLE log)
  file(WRITE ${exemplar_web_build}/npm.log "${log}")
  if(NOT result EQUAL 0)
    set(${why} "npm could not get the packages (${exemplar_web_build}/npm.log)" PARENT_SCOPE)
    return()
  endif()
  file(WRITE ${stamp} ${lock})
endfunction()

set(EXEMPLAR_REPORT_BUNDLES OFF)
if(EXEMPLAR_REPORT_3D)  # ON or AUTO; OFF is false
  exemplar_web_packages(exemplar_web_why)
  if(NOT exemplar_web_why)
    set(EXEMPLAR_REPORT_BUNDLES ON)
  elseif(EXEMPLAR_REPORT_3D STREQUAL AUTO)
    message(STATUS
      "Reports fall back to pictures (EXEMPLAR_REPORT_3D=OFF): ${exemplar_web_why}")
  else()
    message(FATAL_ERROR "EXEMPLAR_REPORT_3D=ON, but ${exemplar_web_why}")
  endif()
else()
  message(STATUS "Reports show pictures in place of surfaces that turn (EXEMPLAR_REPORT_3D=OFF)")
endif()
