#pragma once
// The parts of the extension arcslip._core. It hands data to and fro, and has no opinion: what Python's users
// see is made in Python.

#include <arcslip/scene/study_type.hpp>

#include <nanobind/nanobind.h>

namespace arcslip::python {

/// The laws and the kinds of studies that all scenes know.
const scene::Catalogue& catalogue();

void bind_errors(nanobind::module_& core);
void bind_studies(nanobind::module_& core);
void bind_scene(nanobind::module_& core);
void bind_results(nanobind::module_& core);
void bind_ensembles(nanobind::module_& core);
void bind_figures(nanobind::module_& core);

}  // namespace arcslip::python
