# Where things go when they are installed. The program, the Python package and the modules that both load find what they
# need from their own places (src/base/system/own_folders.h), so the whole may be moved.

# A wheel keeps all of it within the package.
if(SKBUILD)
  set(OMBRE_PYTHON_DIR .)
  set(OMBRE_MODULE_DIR ombre)
  set(OMBRE_DATA_DIR ombre/share/ombre)
  return()
endif()

set(OMBRE_MODULE_DIR lib/ombre)
set(OMBRE_DATA_DIR share/ombre)

# Where Debian's Python looks for packages of the prefix; of ~/.local, too.
function(ombre_python_dir variable version)
  if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set(${variable} lib/python3/dist-packages PARENT_SCOPE)
  elseif(CMAKE_INSTALL_PREFIX STREQUAL "/usr/local")
    set(${variable} lib/python${version}/dist-packages PARENT_SCOPE)
  else()
    set(${variable} lib/python${version}/site-packages PARENT_SCOPE)
  endif()
endfunction()
