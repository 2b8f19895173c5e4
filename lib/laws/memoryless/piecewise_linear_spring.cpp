#include <arcslip/laws/memoryless/piecewise_linear_spring.hpp>

#include <arcslip/laws/memoryless/piecewise_linear.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace arcslip::elements {
namespace {

using Points = std::vector<std::pair<double, double>>;
namespace file = scene::file;

constexpr scene::Field piecewise_linear_spring_fields[] = {
    {.name = "factor",
     .unit = "-",
     .lower = -std::numeric_limits<double>::infinity(),
     .upper = std::numeric_limits<double>::infinity(),
     .default_value = 1,
     .help = "of all forces"},
};

constexpr const char* wanted_points = "a list of at least two points [q, f] (m and N), q ascending";

double slope(const Points& points, std::size_t i) {
  return (points[i + 1].second - points[i].second) / (points[i + 1].first - points[i].first);
}

// What is wrong with a point, or with the segment that ends there.
std::optional<std::string> fault_of(const Points& points, std::size_t i) {
  if (i == 0) return {};
  if (!(points[i].first > points[i - 1].first))
    return "found q = " + file::number_text(points[i].first) + " after " +
           file::number_text(points[i - 1].first) + ", must be ascending";
  const double s = slope(points, i - 1);
  if (!std::isfinite(s) || !std::isfinite(s * points[i].first) || !std::isfinite(s * points[i - 1].first))
    return "found a slope that is too large for a number between f = " +
           file::number_text(points[i - 1].second) + " and " + file::number_text(points[i].second);
  return {};
}

Points read_points(const file::Location& place, scene::file::Faults& faults) {
  const auto* list = file::read_list(place, wanted_points, faults);
  if (list == nullptr) return {};
  Points points;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const file::Location at{&(*list)[i], file::child(place.pointer, i)};
    const auto* pair = file::read_list(at, "a point [q, f]", faults);
    if (pair == nullptr) return {};
    if (pair->size() != 2) {
      faults.add(at.pointer, "found a list of " + std::to_string(pair->size()) + ", must be a point [q, f]");
      return {};
    }
    const auto number = [&](std::size_t k) {
      return file::read_number({&(*pair)[k], file::child(at.pointer, k)}, file::any_number, faults);
    };
    const auto q = number(0), f = number(1);
    if (!q || !f) return {};
    points.emplace_back(*q, *f);
    if (const auto fault = fault_of(points, i)) {
      faults.add(at.pointer, *fault);
      return {};
    }
  }
  if (points.size() < 2)
    faults.add(place.pointer, "found " + std::to_string(points.size()) +
                                  (points.size() == 1 ? " point" : " points") + ", must be " + wanted_points);
  return points;
}

file::KeysOf<PiecewiseLinearTable> table_options() {
  scene::Key key{"table",
                 scene::KeyType::other,
                 "",
                 wanted_points,
                 "",
                 true,
                 "force f at displacements q, linear between and beyond them"};
  key.schema = R"({"type": "array", "minItems": 2, "items":
    {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}})";
  file::KeysOf<PiecewiseLinearTable> keys;
  keys.add({{key},
            [](const file::Reading& reading, PiecewiseLinearTable& table) {
              table.points =
                  read_points(reading.keys.require("table", wanted_points, reading.faults), reading.faults);
            },
            [](const PiecewiseLinearTable& table, const scene::Scene&, file::Node::Object& to) {
              file::Node::List list;
              for (const auto& [q, f] : table.points) list.push_back(file::node(std::vector{q, f}));
              to.push_back({"table", file::Node{std::move(list)}});
            }});
  return keys;
}

// Offsets from both ends of each segment, so that a table that mirrors itself has offsets that do.
PiecewiseLinearShape shape_of(const Points& points) {
  PiecewiseLinearShape shape;
  auto& lines = shape.terms.emplace_back();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (i > 0) shape.corners.push_back(points[i].first);
    const double s = slope(points, i);
    const auto offset = [&](std::size_t k) { return points[k].second - s * points[k].first; };
    lines.push_back({s, 0.5 * (offset(i) + offset(i + 1))});
    shape.names.push_back(i == 0 ? "first" : i + 2 < points.size() ? "between" : "last");
  }
  return shape;
}

class PiecewiseLinearSpring final : public file::KeyedPart<PiecewiseLinearTable, LawType> {
 public:
  PiecewiseLinearSpring() : KeyedPart(table_options()) {}
  std::string_view name() const override { return "piecewise_linear_spring"; }
  std::string_view help() const override { return "a spring whose force is a table, linear between points"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override {
    return piecewise_linear_spring_fields;
  }
  std::shared_ptr<const Law> law(const scene::Settings& options) const override {
    const Points points = options.empty() ? Points() : options.as<PiecewiseLinearTable>().points;
    bool valid = points.size() > 1;
    for (std::size_t i = 1; i < points.size(); ++i) valid = valid && !fault_of(points, i);
    if (!valid) throw std::invalid_argument(std::string("the table of a spring must be ") + wanted_points);
    return std::make_shared<const PiecewiseLinearLaw>(shape_of(points));
  }
};

}  // namespace

const LawType& piecewise_linear_spring() {
  static const PiecewiseLinearSpring law;
  return law;
}

}  // namespace arcslip::elements
