#pragma once
// Piecewise linear laws, with or without sliders, sampled at equal intervals of the period (alternating
// frequency/time, Cameron & Griffin 1989), from their automata: at each sample a slider rests where it was at
// the sample before, or is moved to a bound. Coefficients and derivatives are those of the sampled force; its
// error falls with the square of the samples.
//
// Full stick is that of slider_offset.hpp, with the bounds at the samples (automaton_samples.hpp).

#include <arcslip/laws/law.hpp>

#include <memory>

namespace arcslip::elements {

/// The law must have automata and outlive the element. samples: in a period.
std::unique_ptr<Element> sampled_automata(const Law& law, const Harmonics& harmonics, int samples);

}  // namespace arcslip::elements
