# cmake -D FOLDER=(absolute) -P laws.cmake
# Fails where a product file outside of lib/laws names a law of force: all that is asked of one is in
# lib/laws/law.hpp. The names are those of the files that hold the laws. The scenes that `arcslip new` writes name
# laws as any scene does.
cmake_minimum_required(VERSION 3.25)

file(READ ${FOLDER}/lib/studies/catalogue.cpp catalogue)
string(REGEX MATCHALL "arcslip/laws/[a-z]+/[a-z_]+\\.hpp" headers "${catalogue}")
set(names "")
foreach(header IN LISTS headers)
  get_filename_component(name ${header} NAME_WE)
  list(APPEND names ${name})
endforeach()
list(LENGTH names count)
if(count LESS 3)
  message(FATAL_ERROR "found the laws ${names}, must be at least three")
endif()
list(JOIN names "|" names)

set(wrong "")
file(GLOB_RECURSE files ${FOLDER}/lib/*.?pp ${FOLDER}/optimize/*.?pp ${FOLDER}/app/*.?pp)
list(FILTER files EXCLUDE REGEX "/lib/(laws/|studies/catalogue\\.cpp$|structures\\.hpp$)")  # and the umbrella
list(FILTER files EXCLUDE REGEX "/app/new_scene\\.cpp$")
foreach(file IN LISTS files)
  file(READ ${file} text)
  string(TOLOWER "${text}" text)
  if(text MATCHES "(${names})")
    string(APPEND wrong "  ${file}: ${CMAKE_MATCH_1}\n")
  endif()
endforeach()
if(wrong)
  message(FATAL_ERROR "laws that are named outside of lib/laws:\n${wrong}")
endif()
