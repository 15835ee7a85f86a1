# Run at every build (cmake -P): writes to OUTPUT what the program is built from, but only if that changed.
# Arguments: SOURCE, OUTPUT, VERSION, COMPILER, FLAGS, BUILD_TYPE.
set(commit unknown)
set(dirty false)
find_program(GIT git)
if(GIT AND EXISTS "${SOURCE}/.git")  # an unpacked archive may lie inside somebody else's checkout
  execute_process(COMMAND ${GIT} rev-parse --verify HEAD WORKING_DIRECTORY "${SOURCE}"
    OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    set(commit "${head}")
  endif()
  execute_process(COMMAND ${GIT} status --porcelain -- lib experiments CMakeLists.txt CMakePresets.json
    WORKING_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    set(dirty true)
  endif()
endif()

# The sources that decide results: not how they are printed or chosen.
file(GLOB_RECURSE library LIST_DIRECTORIES false RELATIVE "${SOURCE}"
  "${SOURCE}/lib/bendlab/*.hpp" "${SOURCE}/lib/bendlab/*.cpp" "${SOURCE}/lib/bendlab/*.def")
file(GLOB runner LIST_DIRECTORIES false RELATIVE "${SOURCE}"
  "${SOURCE}/experiments/config/*.?pp" "${SOURCE}/experiments/scene/*.?pp"
  "${SOURCE}/experiments/measures/*.?pp" "${SOURCE}/experiments/measures/*.def"
  "${SOURCE}/experiments/run/*.?pp")
set(sources ${library} ${runner})
list(SORT sources)
set(hashes "")
foreach(source IN LISTS sources)
  file(SHA256 "${SOURCE}/${source}" hash)
  string(APPEND hashes "${source} ${hash}\n")
endforeach()
string(SHA256 hash "${hashes}")
string(SUBSTRING ${hash} 0 16 hash)

string(REGEX REPLACE "[; ]+" " " FLAGS "${FLAGS}")
string(REGEX REPLACE "-W[a-z-]+" "" FLAGS "${FLAGS}")  # warnings decide no result
string(REGEX REPLACE " +" " " FLAGS "${FLAGS}")
string(STRIP "${FLAGS}" FLAGS)
string(CONCAT text
  "#define BENDLAB_VERSION \"${VERSION}\"\n"
  "#define BENDLAB_GIT_COMMIT \"${commit}\"\n"
  "#define BENDLAB_GIT_DIRTY ${dirty}\n"
  "#define BENDLAB_SOURCE_HASH \"${hash}\"\n"
  "#define BENDLAB_COMPILER \"${COMPILER}\"\n"
  "#define BENDLAB_FLAGS \"${FLAGS}\"\n"
  "#define BENDLAB_BUILD_TYPE \"${BUILD_TYPE}\"\n")
set(before "")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" before)
endif()
if(NOT text STREQUAL before)
  file(WRITE "${OUTPUT}" "${text}")
endif()
