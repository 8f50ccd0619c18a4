# The Python that the tests run and that the package is built for: Debian's, and not another one that
# stands first on the path, unless -DPython3_EXECUTABLE names it.
# Sets the option CLACKERS_PYTHON (bindings/python), ON where the tests are built and all it needs is
# there.
set(debian_python /usr/bin/python3)
if(EXISTS ${debian_python})
  set(Python3_EXECUTABLE ${debian_python} CACHE FILEPATH "Python for the package and for the tests")
endif()

set(python_default OFF)
if(CLACKERS_TESTS OR CLACKERS_PYTHON)
  find_package(Python3 3.11 COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 CONFIG QUIET)
  # A module with sanitizers cannot be loaded into an interpreter without them.
  if(Python3_Development.Module_FOUND AND pybind11_FOUND AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    set(python_default ON)
  endif()
endif()
option(CLACKERS_PYTHON "Build the Python package" ${python_default})
if(CLACKERS_PYTHON AND NOT (Python3_Development.Module_FOUND AND pybind11_FOUND))
  message(FATAL_ERROR "The Python package needs Python 3.11 with its headers and pybind11 2.10, of which "
    "one is not there. Run `scripts/setup python`, or leave -DCLACKERS_PYTHON=ON out.")
endif()
