#pragma once
// Phase resonance: the excitation does no reactive work. With the fundamental f of the excitation and x of
// the motion,
//
//   g = Re x^H f / |x^H f| = 0
//
// g is the cosine of the phase by which the motion, along the forces, lags behind them: a quarter period at
// phase resonance, where it falls through zero; at an antiresonance it rises. Under one force it is that of
// the degree of freedom that the force acts at; of a moving base the motion relative to it counts. Lightly
// damped, the resonance peak lies next to it by terms of the order of the damping ratio squared.

#include <arcslip/observables/observe.hpp>

#include <memory>

namespace arcslip::observables {

/// g at the last place of an evaluator, u there; 1 without excitation or motion of that harmonic.
double cosine_of_phase(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, elements::In u);

/// Of branches over the frequency that begin upwards (direction 1) or downwards (-1).
continuation::Monitor phase_resonance_monitor(const std::shared_ptr<Observer>& observer, int direction);

}  // namespace arcslip::observables
