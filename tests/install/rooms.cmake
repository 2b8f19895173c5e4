# cmake -D FOLDER=(absolute, of the source) -P rooms.cmake
# Fails where a file of a room includes a room that it may not see: docs/architecture.md.
cmake_minimum_required(VERSION 3.25)

# What each room sees. A room of lib is called by its name, one of another library by the library's and its own.
set(control control)

set(continuation/problem control continuation/problem)
set(continuation/linear ${continuation/problem} continuation/linear)
set(continuation/events ${continuation/linear} continuation/events)
set(continuation/special_points ${continuation/events} continuation/special_points)
set(continuation/correction ${continuation/events} continuation/correction)
set(continuation/tracing ${continuation/special_points} continuation/correction continuation/tracing)
set(continuation/diagrams ${continuation/tracing} continuation/diagrams)
set(continuation ${continuation/diagrams})

set(results results)
set(sampling sampling)
set(scene control results sampling scene)
set(scene/keys control results sampling scene scene/keys)
set(scene/files control results scene scene/keys scene/files)
set(scene/format control sampling scene scene/keys scene/files scene/format)
set(fourier fourier)
set(formula control formula)
set(laws results scene scene/keys fourier laws)
set(laws/memoryless scene/keys fourier formula laws laws/memoryless)
set(laws/hysteresis scene/keys fourier laws laws/hysteresis)
set(laws/contact fourier laws laws/contact)
set(structure ${continuation} control scene structure)
set(model ${continuation} control results scene scene/files laws structure model)
set(hbm/linear ${continuation} control model hbm/linear)
set(hbm ${continuation} control fourier laws hbm/linear hbm)
set(time/equation ${continuation} control results model time/equation)
set(time/event_driven ${continuation} control time/equation time/event_driven)
set(time/newmark ${continuation} control time/equation time/newmark)
set(time/periodic ${continuation} control results time/equation time/event_driven time/newmark time/periodic)
set(stability ${continuation} control results fourier laws laws/contact hbm time/equation time/event_driven stability)
set(observables ${continuation} results scene fourier laws model hbm stability observables)
set(analyses/branches ${continuation} control results scene fourier model hbm stability observables analyses/branches)
set(analyses/responses ${continuation} control results scene hbm time/periodic stability observables analyses/branches
    analyses/responses)
set(analyses/curves ${continuation} control results scene fourier hbm stability observables analyses/branches
    analyses/responses analyses/curves)
set(analyses/modes_and_time ${continuation} control results scene model hbm time/equation time/periodic stability
    observables analyses/branches analyses/responses analyses/modes_and_time)
set(studies/presentation control results scene laws model observables analyses/modes_and_time
    studies/presentation)
set(studies control results scene scene/keys laws/memoryless laws/hysteresis laws/contact stability observables
    analyses/responses analyses/curves analyses/modes_and_time studies/presentation studies)
set(output control results output)
set(report results sampling scene report)
set(structures ${continuation} control results sampling scene scene/keys scene/files scene/format fourier formula laws laws/memoryless
    laws/hysteresis laws/contact structure model hbm/linear hbm time/equation time/event_driven time/newmark
    time/periodic stability observables analyses/branches analyses/responses analyses/curves analyses/modes_and_time
    studies/presentation studies output report)

set(optimize/nlopt ${structures} optimize/nlopt)
set(optimize/peaks ${structures} optimize/nlopt optimize/peaks)
set(optimize/evaluation ${optimize/peaks} optimize/evaluation)
set(optimize/certificate ${optimize/evaluation} optimize/certificate)
set(optimize/search ${optimize/certificate} optimize/search)
set(optimize/curve ${optimize/search} optimize/curve)
set(optimize/study ${optimize/curve} optimize/study)
set(optimize ${optimize/study} optimize)

file(GLOB folders LIST_DIRECTORIES true RELATIVE ${FOLDER}
     ${FOLDER}/control ${FOLDER}/lib/* ${FOLDER}/lib/*/* ${FOLDER}/continuation/* ${FOLDER}/optimize ${FOLDER}/optimize/*)
set(wrong "")
foreach(folder IN LISTS folders)
  file(GLOB files ${FOLDER}/${folder}/*.hpp ${FOLDER}/${folder}/*.cpp)
  list(REMOVE_ITEM files ${FOLDER}/optimize/optimize.hpp)  # the umbrella
  string(REGEX REPLACE "^lib/" "" room ${folder})
  if(files AND NOT DEFINED ${room})
    string(APPEND wrong "  ${folder}: not in this list\n")
  endif()
  foreach(file IN LISTS files)
    file(STRINGS ${file} includes REGEX "^#include <arcslip/")
    foreach(include IN LISTS includes)
      string(REGEX REPLACE "^#include <arcslip/(.+)/[^/]+>.*" "\\1" seen "${include}")
      if(NOT seen IN_LIST ${room})
        string(APPEND wrong "  ${file}: ${include}\n")
      endif()
    endforeach()
    if(room STREQUAL "results")
      file(STRINGS ${file} others REGEX "^#include <(Eigen|nlohmann)/")
      foreach(other IN LISTS others)
        string(APPEND wrong "  ${file}: ${other}\n")
      endforeach()
    endif()
  endforeach()
endforeach()
if(wrong)
  message(FATAL_ERROR "includes of rooms that may not be seen:\n${wrong}")
endif()
