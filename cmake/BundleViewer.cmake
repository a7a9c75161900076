# cmake -DMODE=AUTO|ON -DNODE=node -DNPM=npm -DWEB=web -DBUILD=folder -DOUT=viewer.js
#       -DLICENSE=license.txt -P BundleViewer.cmake
#
# Writes the script that shows surfaces that turn, with what it uses of three.js, and the license of
# the latter. The packages that web/package-lock.json pins are fetched by npm into BUILD, once for
# each version of that file. Where that fails, AUTO says so in one line and writes two empty files,
# for pages with pictures; ON fails.

function(give_up why)
  if(MODE STREQUAL AUTO)
    message("Reports will show pictures in place of surfaces that turn: ${why} "
            "(to try again: cmake -DEXEMPLAR_REPORT_3D=ON)")
    file(WRITE ${OUT} "")
    file(WRITE ${LICENSE} "")
  else()
    message(FATAL_ERROR "EXEMPLAR_REPORT_3D=ON, but ${why}")
  endif()
endfunction()

if(NOT NODE OR NOT NPM)
  give_up("node and npm are not installed")
  return()
endif()

file(SHA256 ${WEB}/package-lock.json lock)
set(installed "")
if(EXISTS ${BUILD}/installed.txt)
  file(READ ${BUILD}/installed.txt installed)
endif()
if(NOT installed STREQUAL lock)
  file(COPY ${WEB}/package.json ${WEB}/package-lock.json DESTINATION ${BUILD})
  # No package's own scripts are run, and a registry that cannot be reached is given up soon.
  execute_process(
    COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --fetch-retries=1
            --fetch-retry-mintimeout=1000 --fetch-timeout=60000
    WORKING_DIRECTORY ${BUILD} TIMEOUT 300
    RESULT_VARIABLE result OUTPUT_VARIABLE log ERROR_VARIABLE log)
  file(WRITE ${BUILD}/npm.log "${log}")
  if(NOT result EQUAL 0)
    give_up("npm could not get the packages (${BUILD}/npm.log)")
    return()
  endif()
  file(WRITE ${BUILD}/installed.txt ${lock})
endif()

set(modules ${BUILD}/node_modules)
execute_process(
  COMMAND ${CMAKE_COMMAND} -E env NODE_PATH=${modules}
          ${NODE} ${modules}/esbuild/bin/esbuild ${WEB}/viewer.js
          --bundle --minify --format=iife --global-name=ExemplarViewer --target=es2020
          --charset=utf8 --log-level=warning --outfile=${OUT}
  RESULT_VARIABLE result)
if(NOT result EQUAL 0)  # an error in web/: esbuild has said which
  message(FATAL_ERROR "esbuild could not bundle ${WEB}/viewer.js")
endif()
file(COPY_FILE ${modules}/three/LICENSE ${LICENSE})
