# The libraries that exemplar is built with, all from Debian 12's packages (scripts/install.sh names them).

include(GNUInstallDirs)
set(exemplar_libdir ${CMAKE_INSTALL_FULL_LIBDIR})
include(LinkedPackages)

set(CMAKE_FIND_PACKAGE_PREFER_CONFIG ON)
set(exemplar_own_module_path ${CMAKE_MODULE_PATH})
list(APPEND CMAKE_MODULE_PATH ${exemplar_module_path})
foreach(package IN LISTS exemplar_packages)
  separate_arguments(package)
  find_package(${package} REQUIRED)
endforeach()
set(CMAKE_MODULE_PATH ${exemplar_own_module_path})

# Compiled in, so that programs that use the installed libraries do without them.
find_package(Eigen3 CONFIG REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(CLI11 REQUIRED)
