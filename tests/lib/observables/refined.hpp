#pragma once
// The motion of 61 harmonics that a response of harmonic balance is an approximation of.

#include <arcslip/hbm/problem.hpp>
#include <arcslip/results/response.hpp>

#include <memory>
#include <optional>

namespace refined {

using namespace arcslip;

struct Motion {
  std::shared_ptr<const hbm::HbmProblem> problem;
  continuation::Vector u;
};

inline continuation::Vector solution_of(const observables::ResponsePoint& point) {
  return Eigen::Map<const continuation::Vector>(point.unknowns.data(),
                                                static_cast<Eigen::Index>(point.unknowns.size()));
}

/// By Newton's method in more and more harmonics. Nothing where that fails, or leads to another motion.
inline std::optional<Motion> motion(const hbm::HbmProblem& problem, const continuation::Vector& u,
                                    const continuation::Vector& p, std::initializer_list<int> orders) {
  constexpr double another = 0.03;  // relative distance
  Motion now{nullptr, u};
  elements::Harmonics harmonics = problem.harmonics();
  for (const int order : orders) {
    const auto wide = std::make_shared<const hbm::HbmProblem>(
        problem, elements::Harmonics{order, harmonics.odd}, elements::Sampling{});
    continuation::Vector guess(wide->size());
    elements::transfer(harmonics, now.u, wide->harmonics(), guess);
    const auto found = hbm::response_near(*wide, p, guess);
    if (!found || (*found - guess).norm() > another * guess.norm()) return {};
    now = {wide, *found};
    harmonics = wide->harmonics();
  }
  return now;
}

inline constexpr std::initializer_list<int> orders = {21, 31, 61};

}  // namespace refined
