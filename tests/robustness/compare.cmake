# cmake -D PROGRAM=... -D DOCUMENT=... -D MADE=... -P compare.cmake
# Runs PROGRAM, keeps what it prints as MADE and fails where DOCUMENT is not the same.
execute_process(COMMAND ${PROGRAM} OUTPUT_FILE ${MADE} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${MADE} ${DOCUMENT} RESULT_VARIABLE different)
if(different)
  message(FATAL_ERROR "${DOCUMENT} is not what the tests' tables say. Make it again:\n"
                      "  ${PROGRAM} > ${DOCUMENT}")
endif()
