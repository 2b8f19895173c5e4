#include <arcslip/optimize/case_label.hpp>

#include <arcslip/results/text.hpp>
#include <arcslip/studies/units.hpp>

#include <cmath>

namespace arcslip::optimize {
namespace {

void append(std::string& text, const std::string& more) {
  if (!more.empty()) text.append(text.empty() ? "" : ", ").append(more);
}

const scene::Direction* response(const OptimumProblem& problem, const CaseResult& of) {
  const bool has = of.of < problem.cases.size() && problem.cases[of.of].response;
  return has ? &*problem.cases[of.of].response : nullptr;
}

}  // namespace

std::string direction_text(const scene::Scene& scene, const scene::Direction& direction) {
  std::string text;
  for (const scene::Term& term : direction) {
    text.append(term.weight < 0 ? (text.empty() ? "-" : " - ") : text.empty() ? "" : " + ");
    if (std::abs(term.weight) != 1) text.append(results::shortest(std::abs(term.weight))).append(" ");
    text.append(scene.dofs[static_cast<std::size_t>(term.dof)]);
  }
  return text;
}

std::string case_text(const scene::Scene& scene, const OptimumProblem& problem, const CaseResult& of) {
  std::string text = studies::assignment(scene, of.set);
  append(text, studies::assignment(scene, of.scatter));
  if (const auto* direction = response(problem, of))
    append(text, "response at " + direction_text(scene, *direction));
  return text.empty() ? "the scene as it is" : text;
}

std::string case_label(const scene::Scene& scene, const OptimumProblem& problem, const CaseResult& of) {
  std::string text = studies::set_label(scene, of.set);
  append(text, studies::set_label(scene, of.scatter));
  if (const auto* direction = response(problem, of)) append(text, direction_text(scene, *direction));
  return text.empty() ? "as it is" : text;
}

}  // namespace arcslip::optimize
