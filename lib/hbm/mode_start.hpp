#pragma once
// The first motion of a nonlinear mode: that of the linearized structure, corrected, at an amplitude at which
// the two hardly differ.

#include <arcslip/control/run_control.hpp>
#include <arcslip/hbm/linear_modes.hpp>
#include <arcslip/hbm/mode.hpp>

#include <memory>
#include <string>

namespace arcslip::hbm {

struct ModeStart {
  std::shared_ptr<const ModeProblem> problem;
  Vector u;              // unknowns of the problem
  double amplitude = 0;  // m
  std::string no_mode;   // why the linearized structure has no such mode; empty: it has
  std::string failure;   // why no motion was found; empty: it was
};

/// mode: from 1, in the order of the frequencies of the structure linearized about a motion of 1e-9 of the
/// amplitude (m). The motion is at that amplitude, or as far below as the mode is linear, but at most nine
/// decades. model: without_excitation(). If `control` ends, a failure.
///
/// Modes of one frequency have no shapes of their own: any combination is a motion of the linear structure.
/// Of these the one is taken that the fundamental of the excitation drives, such as a travelling wave under
/// an engine order. It must be, in the nonlinear structure, a motion alone among its neighbours, as the
/// symmetry of structure and excitation makes it.
ModeStart mode_start(const std::shared_ptr<const model::Model>& model, const model::Model& excited, int mode,
                     double amplitude, const control::Control& control = {});

}  // namespace arcslip::hbm
