# What the page of a report is made of: the sources in web/ and, bundled with three.js from npm, what
# shows surfaces that turn. Here node and npm are only looked for; the build runs them, and only when
# the page's sources have changed (cmake/BundleViewer.cmake).

set(EXEMPLAR_REPORT_3D AUTO CACHE STRING
    "Surfaces that turn in reports: AUTO (where npm can get three.js), ON (or fail), OFF (pictures)")
set_property(CACHE EXEMPLAR_REPORT_3D PROPERTY STRINGS AUTO ON OFF)

set(EXEMPLAR_WEB_BUILD ${PROJECT_BINARY_DIR}/web)  # where npm puts node_modules
find_program(EXEMPLAR_NODE NAMES node nodejs)
find_program(EXEMPLAR_NPM npm)
mark_as_advanced(EXEMPLAR_NODE EXEMPLAR_NPM)
