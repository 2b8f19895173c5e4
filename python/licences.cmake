# Part of installing the component python: arcslip/licences, the licences of what the wheel carries, as Debian's packages have
# them. FILES: the extension and the command, whose libraries the wheel takes along. HEADERS: packages of what is compiled into
# them. NANOBIND: the file of its licence. Without dpkg there are none but that one.
set(place "${CMAKE_INSTALL_PREFIX}/arcslip/licences")
file(REMOVE_RECURSE "${place}")
file(MAKE_DIRECTORY "${place}")
if(EXISTS "${NANOBIND}")
  configure_file("${NANOBIND}" "${place}/nanobind.txt" COPYONLY)
endif()
find_program(DPKG_QUERY dpkg-query)
if(NOT DPKG_QUERY)
  message(STATUS "The wheel has no licences of libraries: dpkg-query was not found")
  return()
endif()

file(GET_RUNTIME_DEPENDENCIES RESOLVED_DEPENDENCIES_VAR libraries UNRESOLVED_DEPENDENCIES_VAR missing MODULES ${FILES}
     PRE_EXCLUDE_REGEXES "^ld-linux" "^libc[.]so" "^libm[.]so")
set(packages ${HEADERS})
foreach(library IN LISTS libraries)
  file(REAL_PATH "${library}" path)
  foreach(name IN ITEMS "${path}" "/usr${path}" "${library}")  # a library may be listed in /lib or in /usr/lib
    string(REGEX REPLACE "^/usr(/usr)?/lib/" "/lib/" short "${name}")
    foreach(listed IN ITEMS "${name}" "${short}")
      execute_process(COMMAND ${DPKG_QUERY} --search "${listed}" OUTPUT_VARIABLE found ERROR_QUIET)
      if(found MATCHES "^([^:, ]+)")
        list(APPEND packages ${CMAKE_MATCH_1})
      endif()
    endforeach()
  endforeach()
endforeach()
list(REMOVE_DUPLICATES packages)
foreach(package IN LISTS packages)
  execute_process(COMMAND ${DPKG_QUERY} --show "--showformat=\${source:Package}" ${package}
                  OUTPUT_VARIABLE source ERROR_QUIET)
  if(source AND EXISTS "/usr/share/doc/${package}/copyright")
    file(READ "/usr/share/doc/${package}/copyright" text)
    file(WRITE "${place}/${source}.txt" "${text}")
  endif()
endforeach()
