#include <arcslip/observables/stored_energy.hpp>

#include <arcslip/fourier/reversals.hpp>
#include <arcslip/observables/amplitude.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace arcslip::observables {
namespace {

using Eigen::VectorXd;

constexpr int laps = 2;  // after which the memory no longer knows where it began

// The memory of a law of one direction at an angle, marched there from the middle of the motion.
VectorXd marched(elements::TimeLaw& law, int memory, const elements::Harmonics& h, elements::In motion,
                 double theta) {
  elements::Reversals reversals(h);
  std::vector<elements::Reversal> turns = reversals.find(motion.head(h.size()));
  const std::size_t found = turns.size();
  for (std::size_t i = 0; h.odd && i < found; ++i)
    turns.push_back({turns[i].theta + std::numbers::pi, -turns[i].x});
  VectorXd z = VectorXd::Zero(memory);
  if (turns.empty()) return z;
  const auto [low, high] =
      std::minmax_element(turns.begin(), turns.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  z.setConstant(0.5 * (low->x + high->x));
  VectorXd q = VectorXd::Constant(1, turns.front().x), f(1), dq(1);
  elements::StepEnd end(1, memory);
  law.begin(q, z, end);
  f = end.f;
  const auto go_to = [&](double x) {
    dq[0] = x - q[0];
    law.step({q, z, f}, dq, end);
    q[0] = x;
    z += end.dz;
    f = end.f;
  };
  for (int lap = 0; lap < laps; ++lap)
    for (std::size_t i = 1; i <= turns.size(); ++i) go_to(turns[i % turns.size()].x);
  const double from = turns.front().theta,
               ahead = theta - from - turn_angle * std::floor((theta - from) / turn_angle);
  for (std::size_t i = 1; i < turns.size() && turns[i].theta - from < ahead; ++i) go_to(turns[i].x);
  go_to(elements::series_values(h, motion.head(h.size()), theta).x);
  return z;
}

}  // namespace

double stored_energy(const elements::Law& law, elements::Fields fields, const elements::Harmonics& h,
                     elements::In motion, double theta) {
  VectorXd q(law.directions()), z = VectorXd::Zero(law.memory());
  for (int i = 0; i < law.directions(); ++i)
    q[i] = elements::series_values(h, motion.segment(i * h.size(), h.size()), theta).x;
  const auto in_time = law.in_time(fields);
  if (law.memory() > law.directions())
    z = marched(*in_time, law.memory(), h, motion, theta);
  else if (law.memory() > 0)
    in_time->memory_at(q, law.force_at(h, motion, fields, {&theta, 1}).row(0).transpose(), z);
  return in_time->stored(q, z);
}

}  // namespace arcslip::observables
