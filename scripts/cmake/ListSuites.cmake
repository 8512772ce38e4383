# cmake -DPROGRAM=<test program> -DFILE=<file> -P ListSuites.cmake writes the names of the program's suites.
# Those that begin with Nightly are left to `make nightly`, which runs whole programs.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listed}")
list(TRANSFORM suites REPLACE "^\n?([A-Za-z0-9_]+/)?([A-Za-z0-9_]+)\\.$" "\\2")
list(REMOVE_DUPLICATES suites)
list(FILTER suites EXCLUDE REGEX "^Nightly")
file(WRITE ${FILE} "set(suites ${suites})\n")
