# matio 1.5 ships no CMake configuration on Debian. This module finds it, with HDF5, by which it reads files of
# version 7.3, as MatIO::MatIO, and sets MatIO_FOUND and MatIO_VERSION.

find_path(MatIO_INCLUDE_DIR matio.h)
find_library(MatIO_LIBRARY matio)
find_path(MatIO_HDF5_INCLUDE_DIR H5Epublic.h PATH_SUFFIXES hdf5/serial)
find_library(MatIO_HDF5_LIBRARY NAMES hdf5_serial hdf5 PATH_SUFFIXES hdf5/serial)
mark_as_advanced(MatIO_INCLUDE_DIR MatIO_LIBRARY MatIO_HDF5_INCLUDE_DIR MatIO_HDF5_LIBRARY)

set(MatIO_VERSION "")
if(MatIO_INCLUDE_DIR AND EXISTS ${MatIO_INCLUDE_DIR}/matio_pubconf.h)
  file(STRINGS ${MatIO_INCLUDE_DIR}/matio_pubconf.h MatIO_version_lines
       REGEX "#define MATIO_(MAJOR_VERSION|MINOR_VERSION|RELEASE_LEVEL) +[0-9]+")
  foreach(line IN LISTS MatIO_version_lines)
    string(REGEX MATCH "[0-9]+$" number ${line})
    list(APPEND MatIO_version_numbers ${number})
  endforeach()
  list(JOIN MatIO_version_numbers "." MatIO_VERSION)
  unset(MatIO_version_numbers)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MatIO
  REQUIRED_VARS MatIO_LIBRARY MatIO_INCLUDE_DIR MatIO_HDF5_LIBRARY MatIO_HDF5_INCLUDE_DIR
  VERSION_VAR MatIO_VERSION)

if(MatIO_FOUND AND NOT TARGET MatIO::MatIO)
  add_library(MatIO::MatIO UNKNOWN IMPORTED)
  set_target_properties(MatIO::MatIO PROPERTIES
    IMPORTED_LOCATION ${MatIO_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES "${MatIO_INCLUDE_DIR};${MatIO_HDF5_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES ${MatIO_HDF5_LIBRARY})
endif()
