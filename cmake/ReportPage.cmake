# The report page: reports/web, bundled by esbuild into one template and embedded in the program. What npm brings lives
# in <build>/web, never in the source tree. Without node, npm or what they fetch, the program is built without the page.
#
# Sets MOIRE_HAS_PAGE; MOIRE_NODE, the node program; MOIRE_WEB_BUILD, the folder that has node_modules; and
# MOIRE_NO_PAGE, why there is no page.
option(MOIRE_WEB "Build the report page, where node and npm are there" ON)
set(MOIRE_HAS_PAGE OFF)
set(MOIRE_WEB_SOURCE ${PROJECT_SOURCE_DIR}/reports/web)
set(MOIRE_WEB_BUILD ${CMAKE_BINARY_DIR}/web)

find_program(MOIRE_NODE NAMES node nodejs)
find_program(MOIRE_NPM npm)
set(MOIRE_LEAST_NODE 18)
if(MOIRE_NODE)
  execute_process(COMMAND ${MOIRE_NODE} --version
    OUTPUT_VARIABLE node_version OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  string(REGEX REPLACE "^v" "" node_version "${node_version}")
endif()
if(NOT MOIRE_WEB)
  set(MOIRE_NO_PAGE "the program was built with MOIRE_WEB=OFF")
elseif(NOT MOIRE_NODE OR NOT MOIRE_NPM)
  set(MOIRE_NO_PAGE "the program was built without node and npm")
elseif(node_version VERSION_LESS MOIRE_LEAST_NODE)
  set(MOIRE_NO_PAGE "the program was built with node ${node_version}, and the page needs ${MOIRE_LEAST_NODE}")
else()
  # Packages are fetched again only when the lock file is another one.
  file(SHA256 ${MOIRE_WEB_SOURCE}/package-lock.json lock)
  set(stamp ${MOIRE_WEB_BUILD}/packages-${lock}.stamp)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${MOIRE_WEB_SOURCE}/package-lock.json)
  if(NOT EXISTS ${stamp})
    message(STATUS "Fetching the packages of the report page (npm ci)")
    file(GLOB old ${MOIRE_WEB_BUILD}/packages-*.stamp)
    if(old)
      file(REMOVE ${old})
    endif()
    file(COPY ${MOIRE_WEB_SOURCE}/package.json ${MOIRE_WEB_SOURCE}/package-lock.json DESTINATION ${MOIRE_WEB_BUILD})
    # Scripts of packages are not run: esbuild and the others do without.
    execute_process(COMMAND ${MOIRE_NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error
      WORKING_DIRECTORY ${MOIRE_WEB_BUILD} TIMEOUT 600 RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE why)
    if(failed)
      string(REGEX REPLACE "[\r\n]+" " " why "${why}")
      message(STATUS "npm ci: ${why}")
      set(MOIRE_NO_PAGE "the program was built without it, since npm ci failed")
    else()
      file(TOUCH ${stamp})
    endif()
  endif()
  if(EXISTS ${stamp})
    set(MOIRE_HAS_PAGE ON)
  endif()
endif()
if(MOIRE_WEB AND NOT MOIRE_HAS_PAGE)
  message(WARNING "The report page (index.html) is left out: ${MOIRE_NO_PAGE}. Install nodejs (${MOIRE_LEAST_NODE} "
    "or newer) and npm, and configure again; -DMOIRE_WEB=OFF silences this.")
endif()

# moire_report_page(FILE): makes FILE, the bytes of the template as a list of numbers for a C++ array.
function(moire_report_page file)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${MOIRE_WEB_SOURCE}/src/*)
  foreach(name IN ITEMS build.mjs template.html style.css tsconfig.json)
    list(APPEND sources ${MOIRE_WEB_SOURCE}/${name})
  endforeach()
  set(template ${MOIRE_WEB_BUILD}/out/template.html)
  add_custom_command(OUTPUT ${template} VERBATIM COMMENT "Bundling the report page"
    DEPENDS ${sources} ${MOIRE_WEB_SOURCE}/package-lock.json
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${MOIRE_WEB_BUILD}/src
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${MOIRE_WEB_SOURCE} ${MOIRE_WEB_BUILD}
    COMMAND ${MOIRE_NODE} ${MOIRE_WEB_BUILD}/build.mjs ${MOIRE_WEB_BUILD}/out)
  add_custom_command(OUTPUT ${file} VERBATIM COMMENT "Embedding the report page"
    DEPENDS ${template} ${PROJECT_SOURCE_DIR}/cmake/EmbedBytes.cmake
    COMMAND ${CMAKE_COMMAND} -D INPUT=${template} -D OUTPUT=${file} -P ${PROJECT_SOURCE_DIR}/cmake/EmbedBytes.cmake)
endfunction()
