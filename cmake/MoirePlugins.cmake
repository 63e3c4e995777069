# moire_plugins(TARGET NAME...): each NAME is a source file NAME.cpp beside the calling CMakeLists.txt that defines a
# record of the same name. Adds the files to TARGET and writes <folder>/plugins.inc, a list of MOIRE_ITEM(NAME) that the
# room's catalogue includes. A missing file or record is a build error.
function(moire_plugins target)
  set(items "")
  foreach(name IN LISTS ARGN)
    target_sources(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/${name}.cpp)
    string(APPEND items "MOIRE_ITEM(${name})\n")
  endforeach()
  get_filename_component(room ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/generated/${room}_plugins.inc CONTENT "${items}")
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/generated)
endfunction()
