# Run by the installation, with PROGRAM, VERSION and FOLDER: help2man makes a man page of the program and
# of every command from their --help. Without help2man there are none.
find_program(HELP2MAN help2man)
if(NOT HELP2MAN)
  message(STATUS "no man pages: the package help2man is not installed")
  return()
endif()

# `train` and `watch` start programs that may not be there, and then have no --help to make a page of.
function(write_page command page about)
  execute_process(COMMAND ${HELP2MAN} --no-info "--version-string=touchdown ${VERSION}" "--name=${about}"
                          "--output=${FOLDER}/${page}.1" "${command}"
                  ERROR_VARIABLE reason RESULT_VARIABLE failed)
  if(failed)
    message(STATUS "no man page ${page}.1: ${reason}")
  endif()
endfunction()

file(MAKE_DIRECTORY ${FOLDER})
execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
write_page(${PROGRAM} touchdown "testbed for contact estimation on wheeled bipeds")
string(REGEX MATCHALL "\n  [a-z]+ +touchdown " lines "${help}")
foreach(line ${lines})
  string(REGEX MATCH "[a-z]+" verb "${line}")
  write_page("${PROGRAM} ${verb}" touchdown-${verb} "the command `touchdown ${verb}`")
endforeach()
