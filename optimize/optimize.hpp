#pragma once
// The design of least resonance: the studies of kind "optimum", what they call, and NLopt behind one
// function.

#include <arcslip/optimize/curve/optimum_curve.hpp>
#include <arcslip/optimize/nlopt/minimize.hpp>
#include <arcslip/optimize/peaks/peak_amplitude.hpp>
#include <arcslip/optimize/search/optimum.hpp>
#include <arcslip/optimize/studies.hpp>
#include <arcslip/structures.hpp>
