// The extension arcslip._core.

#include "bindings.hpp"

#include <arcslip/results/version.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/stl/string_view.h>

NB_MODULE(_core, core) {
  core.attr("__version__") = arcslip::results::version();
  arcslip::python::bind_errors(core);
  arcslip::python::bind_studies(core);
  arcslip::python::bind_results(core);
  arcslip::python::bind_scene(core);
  arcslip::python::bind_ensembles(core);
  arcslip::python::bind_figures(core);
}
