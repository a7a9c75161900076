# Writes the commit that SOURCE is at into the header OUT, where it has changed; an empty text where
# SOURCE is no checkout. Run by each build: cmake -DSOURCE=... -DOUT=... -P Commit.cmake
cmake_policy(VERSION 3.25)
set(commit "")
find_program(git git)
if(git AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${git} -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT "#define EXEMPLAR_COMMIT \"@commit@\"\n" @ONLY)
