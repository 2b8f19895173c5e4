# matio 1.5 ships no CMake configuration on Debian. This module finds the library, with HDF5, by which it reads
# files of version 7.3, as MatIO::MatIO, and sets MatIO_FOUND and MatIO_VERSION.

find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(PC_MatIO QUIET matio)
endif()
find_path(MatIO_INCLUDE_DIR matio.h HINTS ${PC_MatIO_INCLUDE_DIRS})
find_library(MatIO_LIBRARY matio HINTS ${PC_MatIO_LIBRARY_DIRS})
find_path(MatIO_HDF5_INCLUDE_DIR H5Epublic.h HINTS ${PC_MatIO_INCLUDE_DIRS} PATH_SUFFIXES hdf5/serial)
find_library(MatIO_HDF5_LIBRARY NAMES hdf5 hdf5_serial HINTS ${PC_MatIO_LIBRARY_DIRS} PATH_SUFFIXES hdf5/serial)
mark_as_advanced(MatIO_INCLUDE_DIR MatIO_LIBRARY MatIO_HDF5_INCLUDE_DIR MatIO_HDF5_LIBRARY)
set(MatIO_VERSION "${PC_MatIO_VERSION}")

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
