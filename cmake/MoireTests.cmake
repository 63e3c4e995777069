# moire_test(NAME [LIBS room...] [TIMEOUT seconds]): one doctest executable from NAME.cpp beside the calling
# CMakeLists.txt, linked to the rooms it tests; each test case becomes one ctest test. Its label is the name of its
# doctest suite: cases in TEST_SUITE("slow") stay out of the default run (`ctest -LE slow`).
set(MOIRE_DISCOVER_TESTS ${CMAKE_CURRENT_LIST_DIR}/DiscoverTests.cmake)

function(moire_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "LIBS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  get_filename_component(room ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(target test_${room}_${name})
  add_executable(${target} ${name}.cpp $<TARGET_OBJECTS:moire_test_main>)
  target_link_libraries(${target} PRIVATE ${arg_LIBS} doctest::doctest moire_flags)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  moire_quick_to_compile(${target})

  # A program that is not built counts as a failing test, not as none.
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${target}_tests.cmake)
  add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS ${list} VERBATIM
    COMMAND ${CMAKE_COMMAND} -D EXECUTABLE=$<TARGET_FILE:${target}> -D PREFIX=${room}/ -D TIMEOUT=${arg_TIMEOUT}
      -D DIRECTORY=${CMAKE_CURRENT_BINARY_DIR} -D OUTPUT=${list} -P ${MOIRE_DISCOVER_TESTS})
  file(CONFIGURE OUTPUT ${target}_include.cmake @ONLY CONTENT
"if(EXISTS [==[@list@]==])
  include([==[@list@]==])
else()
  add_test(@room@/@name@_NOT_BUILT @target@_NOT_BUILT)
endif()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake)
endfunction()
