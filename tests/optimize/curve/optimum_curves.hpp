#pragma once
// Scenes and searches next to which curves of optima are held.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/optimize/curve/optimum_curve.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>

#include <string>
#include <vector>

namespace optimum_curves {

using namespace arcslip;
using namespace arcslip::optimize;
using Variables = std::vector<DesignVariable>;

inline const OptimumProblem paper_load{{{"damper.normal_load", 0.01, 1000}}, 18, 22};
inline const Variables both_loads = {{"d1.normal_load", 0.05, 50}, {"d2.normal_load", 0.05, 50}};

inline scene::Scene paper(int order, double damping) {
  scene::Scene s = scenes::paper(order, 3);
  scene::set(s, "c.value", damping);
  return s;
}

inline scene::Scene levels() {
  return scenes::example("levels");
}

inline scene::Scene two_dampers(double start = 0.6) {
  scene::Scene s = scenes::example("two_dampers");
  scene::set(s, "d1.normal_load", start);
  scene::set(s, "d2.normal_load", start);
  return s;
}

inline std::vector<const OptimumEvent*> events(const OptimumCurve& curve, const std::string& kind) {
  std::vector<const OptimumEvent*> all;
  for (const OptimumEvent& event : curve.events)
    if (event.kind == kind) all.push_back(&event);
  return all;
}

// A search at one value, from the design that was followed there.
inline Optimum search(scene::Scene s, const OptimumProblem& problem, const std::string& along,
                      const OptimumPoint& at) {
  scene::set(s, along, at.along);
  for (std::size_t k = 0; k < problem.over.size(); ++k) scene::set(s, problem.over[k].name, at.design[k]);
  return optimum(s, problem, {.certificate = false});
}

inline void check_complete(const OptimumCurve& curve) {
  INFO(curve.stop.message);
  CHECK(curve.status == observables::Status::complete);
  CHECK(curve.stop.reason == reasons::boundary);
  REQUIRE(curve.points.size() >= 2);
}

}  // namespace optimum_curves
