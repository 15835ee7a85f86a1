# BENDLAB_PYTHON: a Python with the modules that the scripts in analysis/ import. The `python3` on PATH often
# cannot import the system's packages (pyenv, conda, a virtual environment), so several Pythons are tried.
set(BENDLAB_PYTHON_MODULES "numpy, h5py, matplotlib, xxhash")

function(bendlab_python_works python result)
  execute_process(COMMAND "${python}" -c "import ${BENDLAB_PYTHON_MODULES}"
    RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  if(failed EQUAL 0)
    set(${result} TRUE PARENT_SCOPE)
  else()
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()

function(bendlab_find_python)
  set(candidates "")
  if(BENDLAB_PYTHON)
    list(APPEND candidates "${BENDLAB_PYTHON}")
  endif()
  find_program(on_path python3 NO_CACHE NO_CMAKE_PATH NO_CMAKE_SYSTEM_PATH)
  if(on_path)
    list(APPEND candidates "${on_path}")
  endif()
  list(APPEND candidates /usr/bin/python3 /usr/local/bin/python3 /opt/homebrew/bin/python3)
  list(REMOVE_DUPLICATES candidates)
  foreach(candidate IN LISTS candidates)
    bendlab_python_works("${candidate}" works)
    if(works)
      set(BENDLAB_PYTHON "${candidate}" CACHE FILEPATH "Python with ${BENDLAB_PYTHON_MODULES}" FORCE)
      message(STATUS "Python with ${BENDLAB_PYTHON_MODULES}: ${candidate}")
      return()
    endif()
  endforeach()
  string(REPLACE ";" ", " tried "${candidates}")
  message(FATAL_ERROR "No Python with ${BENDLAB_PYTHON_MODULES} found (tried ${tried}). Install "
    "python3-numpy, python3-h5py, python3-matplotlib and python3-xxhash, or name a Python that has them: "
    "cmake --preset release -DBENDLAB_PYTHON=/path/to/python3")
endfunction()

bendlab_find_python()
