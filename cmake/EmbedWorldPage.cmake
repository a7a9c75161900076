# cmake -DOUT=x.cpp -DSCRIPT=world.js -DSTYLE=world.css -P EmbedWorldPage.cmake
#
# Writes a C++ source with the page of apps/world_page.h.

file(READ "${SCRIPT}" script)
file(READ "${STYLE}" style)
foreach(text IN ITEMS "${script}" "${style}")
  # That would end the element that the text is in, or the string.
  string(FIND "${text}" "</s" ends)
  string(FIND "${text}" ")page\"" closes)
  if(NOT ends EQUAL -1 OR NOT closes EQUAL -1)
    message(FATAL_ERROR "web/world.js and world.css may hold neither '</s' nor ')page\"'")
  endif()
endforeach()
file(WRITE "${OUT}" "// Made by the build from web/.\n
#include \"apps/world_page.h\"\n
namespace exemplar {\n
std::string worldPage() {
  std::string page = R\"page(<!doctype html>
<html lang=\"en\">
<meta charset=\"utf-8\">
<title>World</title>
<style>
)page\";
  page += R\"page(${style})page\";
  page += R\"page(</style>
<canvas></canvas>
<div id=\"say\"></div>
<script>
)page\";
  page += R\"page(${script})page\";
  page += R\"page(</script>
</html>
)page\";
  return page;
}\n
}  // namespace exemplar\n")
