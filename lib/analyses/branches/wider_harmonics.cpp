#include <arcslip/analyses/branches/wider_harmonics.hpp>

#include <cmath>
#include <utility>
#include <vector>

namespace arcslip::observables {

using continuation::Vector;

namespace {

constexpr double absent = 1e-6;  // of a motion: the harmonics that it lacks

// Of the unknowns of one set of harmonics, those that another one of fewer lacks.
std::vector<int> lacking(const elements::Harmonics& wide, const elements::Harmonics& narrow, int blocks) {
  const auto is_new = [&](int n) {
    const int m = n * narrow.period;
    return m % wide.period != 0 || !narrow.has(m / wide.period);
  };
  std::vector<int> all;
  for (int block = 0; block < blocks; ++block)
    for (int i = 0; i < wide.size(); ++i) {
      const int n = i < wide.cosines() ? wide.cosine_order(i) : wide.sine_order(i - wide.cosines());
      if (is_new(n)) all.push_back(block * wide.size() + i);
    }
  return all;
}

}  // namespace

elements::Harmonics without(const elements::Harmonics& harmonics, BrokenSymmetry symmetry) {
  elements::Harmonics wide = harmonics;
  wide.odd = false;
  if (symmetry == BrokenSymmetry::period) {
    wide.order *= 2;
    wide.period *= 2;
  }
  return wide;
}

std::shared_ptr<const hbm::HbmProblem> in_harmonics(const hbm::HbmProblem& problem,
                                                    const elements::Harmonics& harmonics, double about) {
  auto model = std::make_shared<const model::Model>(model::in_harmonics(problem.model(), harmonics));
  return std::make_shared<const hbm::HbmProblem>(std::move(model), harmonics, problem.displacement(),
                                                 problem.parameters()[model::frequency].scale, about);
}

bool within(const hbm::HbmProblem& problem, const Vector& u, const elements::Harmonics& narrow) {
  double square = 0;
  for (const int i : lacking(problem.harmonics(), narrow, problem.blocks())) square += u[i] * u[i];
  return std::sqrt(square) <= absent * u.norm();
}

continuation::Widening widening(const std::shared_ptr<const hbm::HbmProblem>& narrow,
                                const std::shared_ptr<const hbm::HbmProblem>& wide) {
  const elements::Harmonics few = narrow->harmonics(), all = wide->harmonics();
  return {
      .narrow = narrow,
      .wide = wide,
      .embed = [few, all](continuation::In u, Vector& u_wide) { elements::transfer(few, u, all, u_wide); },
      .added = lacking(all, few, wide->blocks()),
      .free = model::frequency};
}

}  // namespace arcslip::observables
