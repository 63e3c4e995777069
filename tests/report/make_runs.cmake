# Makes the runs that the tests of the report page look at: each study of this folder, and one page of all of them.
#   cmake -D PROGRAM=moire -D OUTPUT=folder -P make_runs.cmake
cmake_minimum_required(VERSION 3.25)
set(runs quick noise filters mitchell92)
file(REMOVE_RECURSE ${OUTPUT})
file(MAKE_DIRECTORY ${OUTPUT})
foreach(run IN LISTS runs)
  execute_process(COMMAND ${PROGRAM} run ${CMAKE_CURRENT_LIST_DIR}/${run}.toml -o ${run} WORKING_DIRECTORY ${OUTPUT}
    OUTPUT_QUIET ERROR_VARIABLE error RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "moire run ${run}.toml: exit code ${status}\n${error}")
  endif()
endforeach()
execute_process(COMMAND ${PROGRAM} report ${runs} -o all.html WORKING_DIRECTORY ${OUTPUT}
  OUTPUT_QUIET ERROR_VARIABLE error RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "moire report: exit code ${status}\n${error}")
endif()
