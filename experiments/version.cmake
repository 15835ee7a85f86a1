# Run at every build (cmake -P). Writes to OUTPUT from which sources and with which compiler the program is
# built, but only if this changed. Arguments: SOURCE, OUTPUT, VERSION, COMPILER, FLAGS, BUILD_TYPE.
set(commit unknown)
set(dirty false)
find_program(GIT git)
if(GIT AND EXISTS "${SOURCE}/.git")  # an unpacked archive may lie inside the checkout of another project
  execute_process(COMMAND ${GIT} rev-parse --verify HEAD WORKING_DIRECTORY "${SOURCE}"
    OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    set(commit "${head}")
  endif()
  execute_process(COMMAND ${GIT} status --porcelain -- lib experiments CMakeLists.txt CMakePresets.json
    WORKING_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    set(dirty true)
    # The patch includes files that git does not track yet.
    execute_process(COMMAND ${GIT} diff --binary HEAD -- lib experiments CMakeLists.txt CMakePresets.json
      WORKING_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE patch ERROR_QUIET)
    execute_process(COMMAND ${GIT} ls-files --others --exclude-standard -- lib experiments
      WORKING_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE untracked ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    string(REPLACE "\n" ";" untracked "${untracked}")
    foreach(file IN LISTS untracked)
      execute_process(COMMAND ${GIT} diff --binary --no-index -- /dev/null "${file}"
        WORKING_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE added ERROR_QUIET)
      string(APPEND patch "${added}")
    endforeach()
  endif()
endif()

# The changes since that commit, compressed, which the program keeps in the folder of results. Left out if
# they are longer than `most`.
get_filename_component(folder "${OUTPUT}" DIRECTORY)
set(packed "")
set(patch_hash "")
string(LENGTH "${patch}" patch_length)
if(patch_length GREATER 0)
  string(SHA256 patch_hash "${patch}")
  string(SUBSTRING ${patch_hash} 0 16 patch_hash)
  set(most 4194304)  # bytes
  if(patch_length GREATER most)
    string(PREPEND patch_hash "too_long_")
  else()
    file(WRITE "${folder}/changes.patch" "${patch}")
    file(ARCHIVE_CREATE OUTPUT "${folder}/changes.gz" PATHS "${folder}/changes.patch" FORMAT raw
      COMPRESSION GZip)
    file(READ "${folder}/changes.gz" packed HEX)
    string(REGEX REPLACE "(..)" "0x\\1," packed "${packed}")
  endif()
endif()
set(changes_file "${folder}/bendlab_changes.hpp")
set(before "")
if(EXISTS "${changes_file}")
  file(STRINGS "${changes_file}" before LIMIT_COUNT 1)
endif()
if(NOT before STREQUAL "// ${patch_hash}")
  file(WRITE "${changes_file}" "// ${patch_hash}\n"
    "constexpr char changes_hash[] = \"${patch_hash}\";\nconstexpr unsigned char changes[] = {${packed}0};\n")
endif()

# The sources that decide results. Sources that only print results or choose runs are left out.
file(GLOB_RECURSE library LIST_DIRECTORIES false RELATIVE "${SOURCE}"
  "${SOURCE}/lib/bendlab/*.hpp" "${SOURCE}/lib/bendlab/*.cpp" "${SOURCE}/lib/bendlab/*.def")
file(GLOB runner LIST_DIRECTORIES false RELATIVE "${SOURCE}"
  "${SOURCE}/experiments/config/*.?pp"
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
string(REGEX REPLACE "-W[a-z-]+" "" FLAGS "${FLAGS}")  # options for warnings affect no result
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
