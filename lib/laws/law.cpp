#include <arcslip/laws/law.hpp>

#include <arcslip/laws/automaton_samples.hpp>
#include <arcslip/laws/sampled_automata.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace arcslip::elements {
namespace {

double largest_stiffness(const Automaton& automaton, int direction) {
  double largest = 0;
  for (const Mode& mode : automaton.modes)
    largest = std::max(largest, std::abs(mode.f_q(direction, direction)));
  return largest;
}

// The mode at q = 0, of a slider that has not moved but by its bounds.
const Mode& mode_at_rest(const Automaton& automaton) {
  const Mode* mode = &automaton.modes.front();
  double z = 0;
  for (std::size_t left = automaton.modes.size(); left > 0; --left) {
    if (!mode->rests) z = mode->z_0;
    const auto leaves = std::find_if(mode->leaves.begin(), mode->leaves.end(), [&](const Guard& guard) {
      return guard.v.isZero(0) && guard.z * z + guard.c < 0;
    });
    if (leaves == mode->leaves.end()) break;
    mode = &automaton.modes[static_cast<std::size_t>(leaves->to)];
  }
  return *mode;
}

void add_slider(const Automaton& automaton, int direction, Traits& traits) {
  double limit = 0;
  for (const Mode& mode : automaton.modes) {
    if (mode.rests || mode.open) continue;
    const double own = std::max(mode.way * mode.f_0[direction], 0.0);
    limit = std::max(limit, own);
    traits.far_work += 2 * own;
  }
  traits.limit += limit;
  traits.holds_in_stick = traits.holds_in_stick || (automaton.offset != Offset::centred && limit > 0);
}

}  // namespace

std::vector<Automaton> automata_of(const Law& law, Fields fields) {
  auto automata = law.automata(fields);
  if (!automata)
    throw std::logic_error("a law that is not piecewise linear has no default for this function");
  const int d = law.directions();
  for (const Automaton& automaton : *automata) {
    const bool fits = automaton.memory < law.memory() && automaton.direction < d &&
                      !automaton.modes.empty() &&
                      std::all_of(automaton.modes.begin(), automaton.modes.end(), [&](const Mode& mode) {
                        return mode.f_q.rows() == d && mode.f_q.cols() == d && mode.f_0.size() == d &&
                               (mode.f_z.size() == d || (mode.f_z.size() == 0 && automaton.memory < 0));
                      });
    if (!fits)
      throw std::logic_error("automata do not fit their law: its directions, or its memory in Law::facts()");
  }
  if (automata->empty()) throw std::logic_error("a law without automata has no default for this function");
  return std::move(*automata);
}

StepEnd::StepEnd(int directions, int memory)
    : f(Eigen::VectorXd::Zero(directions)),
      dz(Eigen::VectorXd::Zero(memory)),
      v(f),
      f_q(Eigen::MatrixXd::Zero(directions, directions)),
      f_z(Eigen::MatrixXd::Zero(directions, memory)),
      f_start(f_q),
      f_v(f_q),
      z_q(Eigen::MatrixXd::Zero(memory, directions)),
      z_z(Eigen::MatrixXd::Identity(memory, memory)),
      z_start(z_q) {}

Traits Law::traits(Fields fields, int direction) const {
  const std::vector<Automaton> all = automata_of(*this, fields);
  const auto slides = [&](const Automaton& each) { return each.memory >= 0 && each.direction == direction; };
  Traits traits;
  if (std::any_of(all.begin(), all.end(), slides)) traits.limit = 0;
  for (const Automaton& automaton : all) {
    const double stiffness = largest_stiffness(automaton, direction);
    traits.stiffness += stiffness;
    const auto differs = [&](const Mode& mode) {
      if (automaton.memory < 0) return mode.f_q != automaton.modes.front().f_q;
      return mode.open && (automaton.direction != direction ||
                           std::any_of(mode.leaves.begin(), mode.leaves.end(),
                                       [](const Guard& guard) { return !guard.q.isZero(0); }));
    };
    traits.several_responses =
        traits.several_responses || std::any_of(automaton.modes.begin(), automaton.modes.end(), differs);
    if (slides(automaton)) {
      add_slider(automaton, direction, traits);
      continue;
    }
    traits.holds_mean = traits.holds_mean || mode_at_rest(automaton).f_q(direction, direction) != 0;
    if (stiffness > 0) traits.far_power = 1;
  }
  return traits;
}

double Law::stiffness(Fields fields, int direction, double) const {
  double sum = 0;
  for (const Automaton& automaton : automata_of(*this, fields))
    sum += largest_stiffness(automaton, direction);
  return sum;
}

std::unique_ptr<Element> Law::element(const Harmonics& harmonics, const Sampling& sampling) const {
  return sampled_automata(*this, harmonics, sampling.samples);
}

Eigen::MatrixXd Law::force_at(const Harmonics& harmonics, In u, Fields fields, Angles angles) const {
  return sampled_force(automata_of(*this, fields), harmonics, u, Sampling{}.samples, angles);
}

std::unique_ptr<TimeLaw> Law::in_time(Fields fields) const {
  return time_law(automata_of(*this, fields));
}

std::vector<Slider> Law::sliders(Fields fields) const {
  std::vector<Slider> sliders;
  if (const auto all = automata(fields))
    for (const Automaton& automaton : *all)
      if (automaton.memory >= 0) sliders.push_back(slider_of(automaton));
  return sliders;
}

Eigen::MatrixXd tangent_at_rest(const Law& law, Fields fields) {
  const int d = law.directions();
  if (law.memory() > 0) {
    Eigen::VectorXd largest(d);
    for (int i = 0; i < d; ++i) largest[i] = law.stiffness(fields, i, 0);
    return largest.asDiagonal();
  }
  StepEnd at(d, 0);
  Eigen::VectorXd memory(0);
  law.in_time(fields)->begin(Eigen::VectorXd::Zero(d), memory, at);
  return 0.5 * (at.f_q + at.f_q.transpose());
}

}  // namespace arcslip::elements
