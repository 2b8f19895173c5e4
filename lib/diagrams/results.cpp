#include <arcslip/diagrams/output.hpp>
#include <arcslip/diagrams/parts.hpp>
#include <arcslip/results/table_of.hpp>
#include <arcslip/results/version.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace arcslip::diagrams {
namespace {

using continuation::Branch;
using continuation::BranchStop;
using continuation::Coefficient;
using continuation::Event;
using continuation::Point;
using results::Object;
using results::Status;
using results::TableOf;
using results::Value;

// The items of the tables.

struct PointRow {
  const Point* point;
};

struct EventRow {
  const Event* event;
  std::string label;
};

struct RangeRow {
  const continuation::StabilityRange* range;
  double from, to;  // the parameter
};

// Real and imaginary parts.
Value eigenvalues(const continuation::Spectrum& spectrum) {
  Value::List all;
  for (const auto& each : spectrum.leading) all.emplace_back(Value::Numbers{each.real(), each.imag()});
  return all;
}

void add_quantities(const Columns& columns, const auto& point_of, auto& table) {
  table.add({columns.parameter}, columns.parameter_unit, "the free parameter",
            [point_of](const auto& row) { return point_of(row).parameter; });
  for (const Quantity& quantity : columns.quantities)
    table.add({quantity.name}, quantity.unit, "",
              [point_of, value = quantity.value](const auto& row) -> std::optional<double> {
                if (point_of(row).u.size() == 0) return {};
                return value(point_of(row));
              });
}

TableOf<PointRow> point_columns(const Columns& columns) {
  TableOf<PointRow> table;
  table.add({"arclength"}, "", "in the scales of the problem, from the start",
            [](const PointRow& row) { return row.point->arclength; });
  add_quantities(columns, [](const PointRow& row) -> const Point& { return *row.point; }, table);
  table.add({"unstable"}, "", "number of eigenvalues with a positive real part",
            [](const PointRow& row) -> std::optional<int> {
              if (!row.point->spectrum) return {};
              return row.point->spectrum->unstable;
            });
  table.add({"eigenvalues"}, "", "the leading ones, [re, im]",
            [](const PointRow& row) -> std::optional<Value> {
              if (!row.point->spectrum || row.point->spectrum->leading.empty()) return {};
              return eigenvalues(*row.point->spectrum);
            });
  return table;
}

// The coefficients of the normal form of a special point, by the names that problem/branch.hpp gives them.
using Named = std::vector<std::pair<const char*, Coefficient>>;
struct NormalForm {
  Named operator()(const std::monostate&) const { return {}; }
  Named operator()(const continuation::Kink&) const { return {}; }
  Named operator()(const continuation::Fold& at) const {
    return {{"quadratic", at.quadratic}, {"unfolding", at.unfolding}};
  }
  Named operator()(const continuation::BranchPoint& at) const {
    return {{"crossing", at.crossing}, {"quadratic", at.quadratic}, {"cubic", at.cubic}};
  }
  Named operator()(const continuation::Hopf& at) const {
    return {{"lyapunov", at.lyapunov}, {"detuning", at.detuning}, {"growth", at.growth}, {"drift", at.drift}};
  }
  Named operator()(const continuation::Cusp& at) const { return {{"cubic", at.cubic}}; }
  Named operator()(const continuation::BogdanovTakens& at) const { return {{"a", at.a}, {"b", at.b}}; }
  Named operator()(const continuation::GeneralizedHopf& at) const {
    return {{"lyapunov", at.lyapunov}, {"detuning", at.detuning}, {"second_lyapunov", at.second_lyapunov}};
  }
  Named operator()(const continuation::ZeroHopf& at) const {
    return {{"g200", at.g200},           {"g011", at.g011},
            {"g300", at.g300},           {"g111", at.g111},
            {"g110_real", at.g110_real}, {"g110_imaginary", at.g110_imaginary},
            {"g210_real", at.g210_real}, {"g210_imaginary", at.g210_imaginary},
            {"g021_real", at.g021_real}, {"g021_imaginary", at.g021_imaginary}};
  }
  Named operator()(const continuation::DoubleHopf& at) const {
    return {{"other_frequency", {at.other_frequency, 0}},
            {"g2100", at.g2100},
            {"g1011", at.g1011},
            {"g1110", at.g1110},
            {"g0021", at.g0021}};
  }
};

std::optional<Value> normal_form(const EventRow& row) {
  Object all;
  for (const auto& [name, coefficient] : std::visit(NormalForm(), row.event->data))
    if (coefficient.known())
      all.push_back({name, Object{{"value", coefficient.value}, {"error", coefficient.error}}});
  if (all.empty()) return {};
  return Value(std::move(all));
}

std::optional<std::string> criticality(const EventRow& row) {
  return std::visit(
      [](const auto& at) -> std::optional<std::string> {
        if constexpr (requires { at.criticality; }) return continuation::name(at.criticality);
        return {};
      },
      row.event->data);
}

std::optional<double> angular_frequency(const EventRow& row) {
  return std::visit(
      [](const auto& at) -> std::optional<double> {
        if constexpr (requires { at.frequency; }) return at.frequency;
        return {};
      },
      row.event->data);
}

TableOf<EventRow> event_columns(const Columns& columns) {
  TableOf<EventRow> table;
  table.add({"kind"}, "", "of the special point; that of a monitor of one's own is event",
            [](const EventRow& row) { return std::string(kind_of(*row.event).name); });
  table.add({"label"}, "", "as in the figures", [](const EventRow& row) { return row.label; });
  table.add({"monitor"}, "", "", [](const EventRow& row) { return row.event->monitor; });
  table.add({"after"}, "", "index of the point before it, from 0",
            [](const EventRow& row) { return static_cast<long>(row.event->after); });
  table.add({"arclength"}, "", "", [](const EventRow& row) { return row.event->point.arclength; });
  add_quantities(columns, [](const EventRow& row) -> const Point& { return row.event->point; }, table);
  table.add({"frequency"}, "rad per time", "of a pair of imaginary eigenvalues", angular_frequency);
  table.add({"criticality"}, "", "whether what emerges there is stable where all else is", criticality);
  table.add({"normal_form"}, "", "its coefficients that are known: value and estimated error", normal_form);
  table.add({"nonsmooth"}, "", "between two pieces",
            [](const EventRow& row) { return row.event->nonsmooth; });
  table.add({"located"}, "", "false: at a neighbouring point",
            [](const EventRow& row) { return row.event->located; });
  return table;
}

TableOf<RangeRow> range_columns(const Columns& columns) {
  TableOf<RangeRow> table;
  table.add({"first"}, "", "index of its first point, from 0",
            [](const RangeRow& row) { return static_cast<long>(row.range->first); });
  table.add({"last"}, "", "", [](const RangeRow& row) { return static_cast<long>(row.range->last); });
  table.add({"from"}, columns.parameter_unit, "the parameter at its first point",
            [](const RangeRow& row) { return row.from; });
  table.add({"to"}, columns.parameter_unit, "", [](const RangeRow& row) { return row.to; });
  table.add({"unstable"}, "", "number of eigenvalues with a positive real part",
            [](const RangeRow& row) { return row.range->unstable; });
  table.add({"complete"}, "", "false: of those found",
            [](const RangeRow& row) { return row.range->complete; });
  return table;
}

TableOf<continuation::HalfBranch> half_branch_columns() {
  TableOf<continuation::HalfBranch> table;
  table.add({"branch"}, "", "that it belongs to, from 1",
            [](const continuation::HalfBranch& half) -> std::optional<int> {
              if (half.branch < 0) return {};
              return half.branch + 1;
            });
  table.add({"untraced"}, "", "why it was not traced",
            [](const continuation::HalfBranch& half) -> std::optional<std::string> {
              if (half.untraced.empty()) return {};
              return half.untraced;
            });
  return table;
}

Object stop_of(const BranchStop& stop) {
  return {{"reason", continuation::name(stop.reason)},
          {"value", stop.value},
          {"limit", stop.limit},
          {"message", stop.message}};
}

Status status_of(const BranchStop& stop, bool has_points) {
  using enum continuation::StopReason;
  if (!has_points) return Status::failed;
  return stop.reason == boundary || stop.reason == closed || stop.reason == event ||
                 stop.reason == known_branch
             ? Status::complete
             : Status::stopped;
}

Object work_of(const Branch& branch) {
  return {{"linear_solver", branch.linear_solver},
          {"points", branch.counts.points},
          {"rejected_steps", branch.counts.rejected_steps},
          {"residuals", branch.counts.residuals},
          {"jacobians", branch.counts.jacobians},
          {"factorizations", branch.counts.factorizations},
          {"solves", branch.counts.solves}};
}

results::Result result_of(const BranchPart& part, bool of_diagram, const Columns& columns) {
  const Branch& branch = *part.branch;
  std::vector<PointRow> points;
  for (const Point& point : branch.points) points.push_back({&point});
  std::vector<EventRow> events;
  for (std::size_t e = 0; e < part.labels.size(); ++e) events.push_back({&branch.events[e], part.labels[e]});
  std::vector<RangeRow> ranges;
  for (const auto& range : part.stability)
    ranges.push_back({&range, branch.points[range.first].parameter, branch.points[range.last].parameter});

  results::Result result;
  if (of_diagram) result.head.facts.push_back({"depth", part.depth});
  if (part.origin >= 0) result.head.facts.push_back({"origin", part.origin + 1});
  result.tables = {point_columns(columns).rows(points), event_columns(columns).rows(events),
                   range_columns(columns).rows(ranges)};
  result.end.status = status_of(branch.stop, !branch.points.empty());
  if (part.begin && result.end.status == Status::complete)
    result.end.status = status_of(*part.begin, !branch.points.empty());
  result.end.stop = stop_of(branch.stop);
  if (part.begin) result.end.facts.push_back({"begin", stop_of(*part.begin)});
  Value::List warnings;
  for (const std::string& warning : branch.warnings) warnings.emplace_back(warning);
  if (!warnings.empty()) result.end.facts.push_back({"warnings", std::move(warnings)});
  result.end.facts.push_back({"solver", work_of(branch)});
  return result;
}

results::Results results_of(const std::vector<BranchPart>& parts, bool of_diagram, const Columns& columns) {
  results::Results all;
  all.header.program = "arcslip " + std::string(results::version());
  all.header.title = columns.title;
  std::size_t leading = 0;
  for (const BranchPart& part : parts)
    for (const Point& point : part.branch->points)
      if (point.spectrum) leading = std::max(leading, point.spectrum->leading.size());
  std::vector<results::Column> of_points = point_columns(columns).columns();
  of_points.back().spread = static_cast<int>(leading);
  all.schemas.push_back({.format = "arcslip-diagram-1",
                         .list = "branches",
                         .noun = "branch",
                         .tables = {{"points", std::move(of_points)},
                                    {"events", event_columns(columns).columns()},
                                    {"stability", range_columns(columns).columns()}}});
  for (const BranchPart& part : parts) all.results.push_back(result_of(part, of_diagram, columns));
  return all;
}

}  // namespace

results::Results results_of(const Branch& branch, const Columns& columns) {
  return results_of(parts_of(branch), false, columns);
}

results::Results results_of(const continuation::WholeBranch& branch, const Columns& columns) {
  return results_of(parts_of(branch), false, columns);
}

results::Results results_of(const continuation::Diagram& diagram, const Columns& columns) {
  results::Results all = results_of(parts_of(diagram), true, columns);
  if (!diagram.complete) all.header.notes.push_back("the diagram is not complete: " + diagram.message);
  all.schemas.push_back({.format = "arcslip-diagram-1",
                         .list = "branch_points",
                         .noun = "branch point",
                         .tables = {{"half_branches", half_branch_columns().columns()}}});
  for (const continuation::Junction& junction : diagram.branch_points) {
    results::Result result;
    result.schema = 1;
    result.head.facts = {{columns.parameter, junction.parameter, columns.parameter_unit},
                         {"depth", junction.depth}};
    if (junction.branch >= 0) result.head.facts.push_back({"branch", junction.branch + 1});
    if (junction.event >= 0) result.head.facts.push_back({"event", junction.event + 1});
    result.tables = {half_branch_columns().rows(junction.half_branches)};
    const bool is_whole = std::all_of(junction.half_branches.begin(), junction.half_branches.end(),
                                      [](const auto& half) { return half.branch >= 0; });
    result.end.status = is_whole ? Status::complete : Status::stopped;
    all.results.push_back(std::move(result));
  }
  return all;
}

}  // namespace arcslip::diagrams
