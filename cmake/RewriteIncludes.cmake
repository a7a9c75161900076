# cmake -DSOURCE=folder -DROOM=sdf "-DROOMS=core;mesh;..." -DOUT=folder -P RewriteIncludes.cmake
#
# Copies the headers of a room, with includes of other headers of the house written as users write
# them: "core/vec.h" becomes <exemplar/core/vec.h>. A header that is as it was is left alone.

list(JOIN ROOMS "|" rooms)
file(GLOB_RECURSE headers RELATIVE ${SOURCE} ${SOURCE}/${ROOM}/*.h)
foreach(header IN LISTS headers)
  file(READ ${SOURCE}/${header} text)
  string(REGEX REPLACE "(#[ \t]*include[ \t]+)\"((${rooms})/[^\"]+)\"" "\\1<exemplar/\\2>" text "${text}")
  set(before "")
  if(EXISTS ${OUT}/${header})
    file(READ ${OUT}/${header} before)
  endif()
  if(NOT "${before}" STREQUAL "${text}")
    file(WRITE ${OUT}/${header} "${text}")
  endif()
endforeach()

# What the repository has no longer is not installed.
file(GLOB_RECURSE copies RELATIVE ${OUT} ${OUT}/${ROOM}/*.h)
foreach(copy IN LISTS copies)
  if(NOT EXISTS ${SOURCE}/${copy})
    file(REMOVE ${OUT}/${copy})
  endif()
endforeach()
