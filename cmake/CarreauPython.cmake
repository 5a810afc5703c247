# SPDX-License-Identifier: BSD-3-Clause
# CARREAU_PYTHON, and CARREAU_PYTHON_EXECUTABLE: a Python with NumPy. CMake may first find a user's Python
# without NumPy, beside the Python of the system.
find_package(Python3 QUIET COMPONENTS Interpreter)
if(NOT CARREAU_PYTHON_EXECUTABLE)
  foreach(candidate IN ITEMS ${Python3_EXECUTABLE} /usr/bin/python3)
    execute_process(COMMAND ${candidate} -c "import numpy, sys; print('%d.%d' % sys.version_info[:2])" RESULT_VARIABLE status
      OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(status EQUAL 0)
      set(CARREAU_PYTHON_EXECUTABLE ${candidate} CACHE FILEPATH "Python with NumPy")
      set(CARREAU_PYTHON_VERSION ${version} CACHE INTERNAL "")
      break()
    endif()
  endforeach()
endif()
if(CARREAU_PYTHON_EXECUTABLE AND BUILD_SHARED_LIBS)
  set(found ON)
else()
  set(found OFF)
endif()
carreau_option(CARREAU_PYTHON "The Python package carreau" ${found}
  "the Python package carreau" "a Python with NumPy was not found (python3-numpy), or the library is static")
