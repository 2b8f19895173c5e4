#include <arcslip/analyses/branches/other_solutions.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/passages.hpp>
#include <arcslip/continuation/diagrams/deflation.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/control/run_control.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace arcslip::observables {

using continuation::Vector;

namespace {

constexpr double least_factor = 1e-3, largest_factor = 1e3;  // of the excitation
constexpr double factor_step = 0.5;                          // of the factor
constexpr long most_points_over_factor = 200;
constexpr int proposed_orders = 3;  // times the highest one of the excitation
constexpr int most_proposals = 16;

bool are_same(const Vector& a, const Vector& b) {
  return (a - b).norm() <= same_solution * b.norm();
}

// x(theta + phi), times a factor.
Vector shifted(const hbm::HbmProblem& problem, const Vector& u, double phi, double factor) {
  const auto& h = problem.harmonics();
  Vector image = u;
  for (int block = 0; block < problem.blocks(); ++block) {
    const Eigen::Index at = block * h.size();
    for (int j = 0; j < h.sines(); ++j) {
      const int n = h.sine_order(j);
      const double a = u[at + h.cosine_index(n)], b = u[at + h.sine_index(n)];
      image[at + h.cosine_index(n)] = a * std::cos(n * phi) + b * std::sin(n * phi);
      image[at + h.sine_index(n)] = b * std::cos(n * phi) - a * std::sin(n * phi);
    }
  }
  return factor * image;
}

bool mirrors(const hbm::HbmProblem& problem) {
  const auto& all = problem.model().excitation;
  return problem.model().antisymmetric && !problem.harmonics().odd &&
         std::all_of(all.begin(), all.end(), [](const auto& each) { return each.harmonic % 2 == 1; });
}

}  // namespace

EndSearch end_search(const model::Model& model) {
  const auto several = elements_with_several_responses(model);
  if (several == 0) return EndSearch::needless;
  return several > most_searched_elements ? EndSearch::left_out : EndSearch::made;
}

std::string without_search(const model::Model& model) {
  if (end_search(model) != EndSearch::left_out) return {};
  return "; other responses were not looked for, since " +
         std::to_string(elements_with_several_responses(model)) +
         " elements may have several at one frequency; frf with \"branches\": \"all\" looks for them";
}

std::vector<Vector> images(const hbm::HbmProblem& problem, const Vector& u) {
  const double half = std::numbers::pi / problem.harmonics().period;  // of a period of the excitation
  std::vector<Vector> all;
  for (int k = 0; k < 2 * problem.harmonics().period; ++k)
    if (k % 2 == 0 || mirrors(problem)) all.push_back(shifted(problem, u, k * half, k % 2 == 0 ? 1 : -1));
  return all;
}

std::size_t index_of(const hbm::HbmProblem& problem, const Vector& u, const std::vector<Vector>& all) {
  const std::vector<Vector> same = images(problem, u);
  const auto is_it = [&](const Vector& each) {
    return std::any_of(same.begin(), same.end(), [&](const Vector& image) { return are_same(image, each); });
  };
  return static_cast<std::size_t>(std::find_if(all.begin(), all.end(), is_it) - all.begin());
}

std::vector<Vector> solutions_at(const hbm::HbmProblem& problem, std::span<const ResponsePoint> branch,
                                 double omega) {
  const Vector p = hbm::parameters_at(problem, omega);
  std::vector<Vector> all;
  for (std::size_t i = 0; i + 1 < branch.size(); ++i) {
    const Solution &from = branch[i], &to = branch[i + 1];
    if ((from.omega - omega) * (to.omega - omega) > 0 || from.omega == to.omega) continue;
    const double share = (omega - from.omega) / (to.omega - from.omega);
    const Eigen::Map<const Vector> a(from.unknowns.data(), problem.size()),
        b(to.unknowns.data(), problem.size());
    if (auto found = hbm::response_near(problem, p, (1 - share) * a + share * b))
      all.push_back(std::move(*found));
  }
  return all;
}

std::optional<Vector> solution_nearby(const hbm::HbmProblem& problem, const Vector& p,
                                      const std::vector<Vector>& known, const control::Control& control) {
  std::vector<Vector> all, guesses{Vector::Zero(problem.size())};
  if (const Vector linear = hbm::linear_response(problem, p); linear.allFinite()) guesses.push_back(linear);
  for (const Vector& each : known) {
    guesses.push_back(each);
    for (Vector& image : images(problem, each)) {
      const auto is_it = [&](const Vector& other) {
        return (other - image).norm() <= same_solution * image.norm();
      };
      if (std::none_of(all.begin(), all.end(), is_it)) all.push_back(std::move(image));
    }
  }
  continuation::DeflationOptions options;
  options.solutions = 1;
  options.control = control;
  const auto found = continuation::deflate(problem, p, all, guesses, options);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

namespace {

// The same with few harmonics, which propose responses at a part of the cost.
std::shared_ptr<const hbm::HbmProblem> proposing(const std::shared_ptr<const hbm::HbmProblem>& problem) {
  int excited = problem->model().force_harmonic;
  for (const auto& each : problem->model().excitation) excited = std::max(excited, each.harmonic);
  elements::Harmonics few = problem->harmonics();
  few.order = proposed_orders * few.excited(excited);
  if (few.order >= problem->harmonics().order) return problem;
  return std::make_shared<const hbm::HbmProblem>(*problem, few, problem->sampling());
}

Vector transferred(const hbm::HbmProblem& from, const Vector& u, const hbm::HbmProblem& to) {
  const int size = from.harmonics().size(), other = to.harmonics().size();
  Vector v(to.size());
  for (int k = 0; k < from.blocks(); ++k)
    elements::transfer(from.harmonics(), u.segment(k * size, size), to.harmonics(),
                       v.segment(k * other, other));
  return v;
}

// Those where the branch over the excitation factor through u passes 1.
std::vector<Vector> on_excitation_branch(const std::shared_ptr<const hbm::HbmProblem>& problem,
                                         const Vector& p, const Vector& u, const control::Control& control) {
  const int factor = problem->excitation_factor();
  Passages passages(*problem, p, factor);
  continuation::Options options;
  options.lower = least_factor;
  options.upper = largest_factor;
  options.check_jacobian = false;
  options.step.largest_parameter = largest_factor;
  options.step.relative_parameter = factor_step;
  options.largest_state = resolvable;
  options.points = most_points_over_factor;
  options.control = control;
  std::vector monitors{continuation::fold_monitor(), passage_monitor(1)};
  monitors[0].divides_at_kinks = false;
  for (const int direction : {1, -1}) {
    const auto branch = continuation::trace(problem, {u, p, factor, direction}, options, monitors);
    passages.take(branch);
    if (branch.stop.reason == continuation::StopReason::closed) break;
  }
  return std::move(passages.u);
}

// Solutions of `problem` that are none of those known, nor images of them.
std::vector<Vector> search_nearby(const std::shared_ptr<const hbm::HbmProblem>& problem, const Vector& p,
                                  const std::vector<Vector>& known, const control::Control& control) {
  std::vector<Vector> all = known;
  std::vector<bool> is_reached(all.size(), false);  // by the branch over the excitation through another
  const auto stopped = [&] { return !control.keep_going(); };
  for (int k = 0; k < most_proposals && !stopped(); ++k) {
    for (std::size_t i = 0; i < all.size() && !stopped(); ++i) {
      if (is_reached[i]) continue;
      is_reached[i] = true;
      for (Vector& u : on_excitation_branch(problem, p, Vector(all[i]), control)) {
        const std::size_t at = index_of(*problem, u, all);
        if (at == all.size()) {
          all.push_back(std::move(u));
          is_reached.push_back(true);
        }
        is_reached[at] = true;
      }
    }
    auto other = solution_nearby(*problem, p, all, control);
    if (!other || index_of(*problem, *other, all) < all.size()) break;
    all.push_back(std::move(*other));
    is_reached.push_back(false);
  }
  all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(known.size()));
  return all;
}

}  // namespace

std::vector<Vector> further_responses(const std::shared_ptr<const hbm::HbmProblem>& problem, const Vector& p,
                                      const std::vector<Vector>& known, const control::Control& control) {
  const auto few = proposing(problem);
  if (few == problem) return search_nearby(problem, p, known, control);
  std::vector<Vector> proposed, all = known;
  for (const Vector& u : known)
    if (auto start = hbm::response_near(*few, p, transferred(*problem, u, *few)))
      proposed.push_back(std::move(*start));
  for (const Vector& u : search_nearby(few, p, proposed, control))
    if (auto found = hbm::response_near(*problem, p, transferred(*few, u, *problem));
        found && index_of(*problem, *found, all) == all.size())
      all.push_back(std::move(*found));
  all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(known.size()));
  return all;
}

}  // namespace arcslip::observables
