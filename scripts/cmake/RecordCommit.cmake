# cmake -DSOURCE=<folder> -DFILE=<file> -P RecordCommit.cmake
# writes the commit of the sources, as `git describe` names it, into a file, if the file differs.
set(commit "unknown: built from sources without their git history")
find_program(GIT git)
if(GIT)
  # A source archive may have been unpacked inside another project's checkout.
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-cdup
                  OUTPUT_VARIABLE above ERROR_QUIET RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed EQUAL 0 AND above STREQUAL "")
    execute_process(COMMAND ${CMAKE_COMMAND} -E env GIT_OPTIONAL_LOCKS=0
                            ${GIT} -C ${SOURCE} describe --always --dirty --abbrev=12
                    OUTPUT_VARIABLE described ERROR_QUIET RESULT_VARIABLE failed
                    OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(failed EQUAL 0)
      set(commit "${described}")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${FILE} CONTENT "${commit}\n")
