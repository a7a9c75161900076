# cmake -DOUT=x.cpp "-DPARTS=name=file|name=file" -P EmbedText.cmake
#
# Writes a C++ source with the functions of report/resources.h, each returning the bytes of its file;
# a name without a file is empty.

string(REPLACE "|" ";" parts "${PARTS}")
set(source "// Made by the build from web/.\n\n#include \"report/resources.h\"\n\nnamespace exemplar::resources {\n")
foreach(part IN LISTS parts)
  string(REGEX MATCH "^([a-z]+)=(.*)$" unused "${part}")
  set(name ${CMAKE_MATCH_1})
  set(file ${CMAKE_MATCH_2})
  if(NOT file)
    string(APPEND source "\nstd::string_view ${name}() { return {}; }\n")
    continue()
  endif()
  file(READ "${file}" text)
  # That would end the element that the text is in.
  string(TOLOWER "${text}" text)
  string(FIND "${text}" "</script" script)
  string(FIND "${text}" "</style" style)
  if(NOT script EQUAL -1 OR NOT style EQUAL -1)
    message(FATAL_ERROR "${file} holds '</script' or '</style'; write it otherwise")
  endif()
  file(READ "${file}" bytes HEX)
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(APPEND source "
namespace {
constexpr unsigned char k_${name}[] = {
${bytes}0};
}
std::string_view ${name}() {
  return {reinterpret_cast<const char*>(k_${name}), sizeof k_${name} - 1};
}
")
endforeach()
string(APPEND source "\n}  // namespace exemplar::resources\n")
file(WRITE ${OUT} "${source}")
