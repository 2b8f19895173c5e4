#include <arcslip/diagrams/parts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace arcslip::diagrams {
namespace {

using continuation::Branch;
using continuation::Point;
using results::EventKind;
using results::Shape;

// In the order of the alternatives of EventData; the first one of events without data.
constexpr std::array<EventKind, std::variant_size_v<continuation::EventData>> kinds = {
    {{"event", "event", {Shape::star, 0.9, 1.5}},
     {"fold", "fold", {Shape::square, 1.2, 1.5}},
     {"branch_point", "branch point", {Shape::filled_circle, 0.8}},
     {"hopf", "Hopf point", {Shape::circle, 1, 1.5}},
     {"kink", "kink", {Shape::cross, 0.7, 1}},
     {"cusp", "cusp", {Shape::filled_diamond, 1.1}},
     {"bogdanov_takens", "Bogdanov-Takens point", {Shape::triangle, 1, 1.5}},
     {"generalized_hopf", "generalized Hopf point", {Shape::diamond, 1.1, 1.5}},
     {"zero_hopf", "zero-Hopf point", {Shape::inverted_triangle, 1, 1.5}},
     {"double_hopf", "double Hopf point", {Shape::pentagon, 1, 1.5}}}};

std::string words_of(const continuation::Event& event) {
  const EventKind& kind = kind_of(event);
  return &kind == &kinds.front() ? event.monitor : std::string(kind.words);
}

// The number of the branch point of a diagram that an event is, from 1: the nearest one; 0: none. Every
// branch point of its branches is in the list.
int number_of(const continuation::Event& event, const std::vector<continuation::Junction>& branch_points) {
  if (!std::holds_alternative<continuation::BranchPoint>(event.data) || branch_points.empty()) return 0;
  const auto distance = [&](const continuation::Junction& other) {
    return std::hypot((other.u - event.point.u).norm(), other.parameter - event.point.parameter);
  };
  const auto nearest =
      std::min_element(branch_points.begin(), branch_points.end(),
                       [&](const auto& one, const auto& other) { return distance(one) < distance(other); });
  return static_cast<int>(nearest - branch_points.begin()) + 1;
}

std::vector<BranchPart> labelled(std::vector<BranchPart> parts,
                                 const std::vector<continuation::Junction>& branch_points = {}) {
  std::map<std::string, int> all, so_far;
  for (const BranchPart& part : parts)
    for (const continuation::Event& event : part.branch->events)
      if (number_of(event, branch_points) == 0) ++all[words_of(event)];
  for (BranchPart& part : parts)
    for (const continuation::Event& event : part.branch->events) {
      std::string& label = part.labels.emplace_back(words_of(event));
      if (const int number = number_of(event, branch_points); number > 0) {
        if (branch_points.size() > 1) label += " " + std::to_string(number);
      } else if (all[label] > 1) {
        label += " " + std::to_string(++so_far[label]);
      }
    }
  return parts;
}

}  // namespace

std::vector<BranchPart> parts_of(const Branch& branch) {
  return labelled({{&branch, nullptr, continuation::stability_ranges(branch)}});
}

std::vector<BranchPart> parts_of(const continuation::WholeBranch& branch) {
  return labelled({{&branch.branch, &branch.begin, continuation::stability_ranges(branch.branch)}});
}

std::vector<BranchPart> parts_of(const continuation::Diagram& diagram) {
  std::vector<BranchPart> all;
  for (const continuation::DiagramBranch& each : diagram.branches)
    all.push_back({&each.branch, &each.begin, each.stability, each.depth, each.origin});
  return labelled(std::move(all), diagram.branch_points);
}

const EventKind& kind_of(const continuation::Event& event) {
  if (event.data.index() > 0) return kinds[event.data.index()];
  const auto* const by_name = std::find(kinds.begin(), kinds.end(), event.monitor);
  return by_name == kinds.end() ? kinds.front() : *by_name;
}

Columns columns_of(const continuation::Problem& problem, int free, std::vector<std::string> names) {
  const auto parameters = problem.parameters();
  if (free < 0 || free >= static_cast<int>(parameters.size()))
    throw std::invalid_argument("the free parameter is " + std::to_string(free) + ", must be from 0 to " +
                                std::to_string(parameters.size() - 1));
  const int n = problem.size();
  if (!names.empty() && static_cast<int>(names.size()) != n)
    throw std::invalid_argument(std::to_string(names.size()) + " names are given for " + std::to_string(n) +
                                " unknowns");
  const continuation::Parameter& parameter = parameters[static_cast<std::size_t>(free)];
  Columns columns{.parameter = parameter.name, .parameter_unit = parameter.unit, .quantities = {}};
  if (names.empty() && n > most_unknowns) {
    columns.quantities.push_back({"norm", "", [](const Point& point) { return point.u.norm(); }});
    return columns;
  }
  for (int i = 0; i < n; ++i)
    columns.quantities.push_back(
        {names.empty() ? "u_" + std::to_string(i + 1) : std::move(names[static_cast<std::size_t>(i)]), "",
         [i](const Point& point) { return point.u[i]; }});
  return columns;
}

}  // namespace arcslip::diagrams
