# Asks one doctest program for its test cases and writes a CTest file: a test each, labelled with its suite. Run by
# moire_test() after each build of a test program:
#   cmake -D EXECUTABLE=... -D PREFIX=room/ -D TIMEOUT=seconds -D DIRECTORY=... -D OUTPUT=file -P DiscoverTests.cmake
# doctest ships such a script, but one test whose name has a comma or a bracket makes it write a file that CTest
# refuses, with all tests in it; and it starts the program once more for every test case.
cmake_minimum_required(VERSION 3.25)
set(labels unit io cli heavy slow)

execute_process(COMMAND ${EXECUTABLE} --list-test-cases --reporters=xml
  OUTPUT_VARIABLE listing ERROR_VARIABLE listing_error RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${EXECUTABLE} does not list its test cases (${result}):\n${listing}${listing_error}")
endif()

# One <TestCase name="..." testsuite="..." .../> after the other, by position: CMake's lists would split names.
set(script "")
set(open "<TestCase name=\"")
while(TRUE)
  string(FIND "${listing}" "${open}" at)
  if(at EQUAL -1)
    break()
  endif()
  string(LENGTH "${open}" skip)
  math(EXPR at "${at} + ${skip}")
  string(SUBSTRING "${listing}" ${at} -1 listing)
  string(FIND "${listing}" "\"" end)
  string(SUBSTRING "${listing}" 0 ${end} name)
  string(REGEX MATCH "^[^\n]*testsuite=\"([^\"]*)\"" unused "${listing}")
  set(suite "${CMAKE_MATCH_1}")

  foreach(pair "lt/<" "gt/>" "quot/\"" "apos/'" "amp/&")
    string(REPLACE "/" ";" pair "${pair}")
    list(GET pair 0 entity)
    list(GET pair 1 character)
    string(REPLACE "&${entity};" "${character}" name "${name}")
  endforeach()

  # The program finds the test by a pattern: * and ? are wildcards and a backslash escapes.
  if(name MATCHES "[*?\\;]" OR name MATCHES "]==]")
    message(FATAL_ERROR "test \"${name}\": its name must not contain * ? ; or a backslash")
  endif()
  if(NOT suite IN_LIST labels)
    message(FATAL_ERROR "test \"${name}\": TEST_SUITE(\"${suite}\") is not a label; known are unit, io, cli, heavy and slow")
  endif()
  set(test "[==[${PREFIX}${name}]==]")
  string(FIND "${script}" "add_test(${test} " twice)
  if(NOT twice EQUAL -1)
    message(FATAL_ERROR "test \"${name}\": there are two of this name in ${EXECUTABLE}")
  endif()

  string(REPLACE "," "\\," pattern "${name}")
  # A pattern that matches nothing would pass.
  string(APPEND script
    "add_test(${test} [==[${EXECUTABLE}]==] [==[--test-case=${pattern}]==])\n"
    "set_tests_properties(${test} PROPERTIES LABELS ${suite} TIMEOUT ${TIMEOUT} WORKING_DIRECTORY [==[${DIRECTORY}]==]\n"
    "  FAIL_REGULAR_EXPRESSION [==[test cases: +0 [|]]==])\n")
endwhile()

if(script STREQUAL "")
  message(FATAL_ERROR "${EXECUTABLE} has no test cases")
endif()
file(WRITE "${OUTPUT}" "${script}")
