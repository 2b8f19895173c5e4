#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/scene/patch.hpp>
#include <arcslip/studies/presentation/figure_parts.hpp>
#include <arcslip/studies/presentation/units.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace arcslip::studies {
namespace {

using observables::ElementResponse;
using observables::ResponseBranch;
using observables::ResponsePoint;
using results::FigureData;
using results::FigureTile;
using results::Range;
using results::Scale;
using scene::PatchRow;

// What a map shows of a contact with an area; NaN: nothing.
struct Mapped {
  const char* name;
  const char* words;
  const char* unit;
  Scale scale;
  double (*value)(const ElementResponse& contact, double area);
};

constexpr Mapped all_mapped[] = {
    {"stick", "share in stick", "%", Scale::percent,
     [](const ElementResponse& of, double) { return of.stick_percent; }},
    {"separation", "share in separation", "%", Scale::percent,
     [](const ElementResponse& of, double) {
       return of.has_normal_load ? of.open_percent : observables::no_value;
     }},
    {"pressure", "largest pressure", "Pa", Scale::linear,
     [](const ElementResponse& of, double area) {
       return of.has_normal_load ? of.normal_load_max / area : observables::no_value;
     }},
    {"dissipation", "energy dissipated per period", "J/m²", Scale::linear,
     [](const ElementResponse& of, double area) { return of.energy / area; }},
    {"wear", "wear depth rate", "m/s", Scale::linear,
     [](const ElementResponse& of, double area) { return of.wear_rate / area; }},
};

constexpr int digits_of_frequency = 6;

struct Peak {
  const ResponseBranch* branch = nullptr;
  const ResponsePoint* point = nullptr;
};

Peak highest_peak(std::span<const ResponseBranch> branches) {
  Peak highest;
  for (const ResponseBranch& branch : branches)
    for (const observables::ResponseEvent& event : branch.events)
      if (event.kind == observables::event_kinds::peak.name && !event.point.unbounded &&
          (highest.point == nullptr || event.point.amplitude > highest.point->amplitude))
        highest = {&branch, &event.point};
  return highest;
}

// From the least to the largest value of a coordinate.
double extent(const std::vector<PatchRow>& rows, std::size_t c) {
  const auto [least, most] = std::minmax_element(
      rows.begin(), rows.end(), [c](const auto& a, const auto& b) { return (*a.place)[c] < (*b.place)[c]; });
  return (*most->place)[c] - (*least->place)[c];
}

// The length next to which others are rounding: of the patch, or of a contact.
double size_of(const std::vector<PatchRow>& rows) {
  double area = 0;
  for (const PatchRow& row : rows) area = std::max(area, row.area);
  return std::max({extent(rows, 0), extent(rows, 1), std::sqrt(area)});
}

// The mean distance of neighbours among the different values of a coordinate; 0: there is one value.
double spacing(const std::vector<PatchRow>& rows, std::size_t c) {
  constexpr double equal = 1e-6;
  const double apart = equal * size_of(rows);
  std::vector<double> values;
  for (const PatchRow& row : rows) values.push_back((*row.place)[c]);
  std::sort(values.begin(), values.end());
  const auto last = std::unique(values.begin(), values.end(),
                                [apart](double a, double b) { return std::abs(a - b) <= apart; });
  const auto different = last - values.begin();
  return different > 1 ? extent(rows, c) / static_cast<double>(different - 1) : 0;
}

// The sides of the rectangle of an area. In a row of contacts it ends where the next one begins.
std::array<double, 2> sides(double area, double along_x, double along_y) {
  if (along_x > 0 && along_y > 0)
    return {std::sqrt(area * along_x / along_y), std::sqrt(area * along_y / along_x)};
  if (along_x > 0) return {along_x, area / along_x};
  if (along_y > 0) return {area / along_y, along_y};
  return {std::sqrt(area), std::sqrt(area)};
}

std::vector<FigureTile> tiles_of(const std::vector<PatchRow>& rows, std::span<const ElementResponse> contacts,
                                 const Mapped& mapped) {
  const double along_x = spacing(rows, 0), along_y = spacing(rows, 1);
  std::vector<FigureTile> tiles;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double value = mapped.value(contacts[i], rows[i].area);
    if (!std::isfinite(value)) continue;
    const auto [width, height] = sides(rows[i].area, along_x, along_y);
    const auto [x, y] = *rows[i].place;
    tiles.push_back({x - width / 2, x + width / 2, y - height / 2, y + height / 2, value});
  }
  return tiles;
}

// The ranges of both axes, of one scale on a figure that is wider than high.
void set_ranges(const std::vector<FigureTile>& tiles, FigureData& data) {
  constexpr double shape = 1.5, infinity = std::numeric_limits<double>::infinity();
  Range x{infinity, -infinity}, y = x;
  for (const FigureTile& tile : tiles) {
    x = {std::min(x.lower, tile.left), std::max(x.upper, tile.right)};
    y = {std::min(y.lower, tile.lower), std::max(y.upper, tile.upper)};
  }
  const double width = std::max(x.upper - x.lower, shape * (y.upper - y.lower));
  const auto widened = [](const Range& of, double to) {
    const double middle = 0.5 * (of.lower + of.upper);
    return Range{middle - to / 2, middle + to / 2};
  };
  data.columns[0].range = widened(x, width);
  data.columns[1].range = widened(y, width / shape);
}

FigureData map_of(const scene::Scene& scene, const scene::Part& patch, const Peak& peak,
                  std::span<const ElementResponse> contacts) {
  FigureData data{.name = "patch_" + patch.name, .title = scene.title, .columns = {{"x", "m"}, {"y", "m"}}};
  const std::string set = set_label(scene, peak.branch->set);
  for (const Mapped& mapped : all_mapped) {
    results::FigureView view{
        .name = mapped.name,
        .tiles = tiles_of(patch.options.as<scene::PatchOptions>().rows, contacts, mapped),
        .value = {mapped.words, mapped.unit, mapped.scale},
        .note = patch.name + " at the resonance peak at " +
                results::readable(in_scene_unit(scene, peak.point->omega),
                                  scene::unit_name(scene.frequency_unit), digits_of_frequency) +
                (set.empty() ? "" : ", " + set)};
    if (view.tiles.empty()) continue;
    const auto [least, most] =
        std::minmax_element(view.tiles.begin(), view.tiles.end(),
                            [](const FigureTile& a, const FigureTile& b) { return a.value < b.value; });
    view.value.range = mapped.scale == Scale::percent ? Range{0, 100} : Range{least->value, most->value};
    set_ranges(view.tiles, data);
    data.figures.push_back(std::move(view));
  }
  return data;
}

}  // namespace

std::vector<FigureData> patch_maps(const scene::Scene& scene, std::span<const ResponseBranch> branches) {
  std::vector<FigureData> all;
  const Peak peak = highest_peak(branches);
  std::size_t first = scene.elements.size();  // of its contacts among all elements
  for (const scene::Part& patch : scene.patches) {
    const auto& rows = patch.options.as<scene::PatchOptions>().rows;
    const std::size_t own = first;
    first += rows.size();
    if (peak.point == nullptr || peak.point->elements.size() < first || !rows.front().place) continue;
    all.push_back(map_of(scene, patch, peak, std::span(peak.point->elements).subspan(own, rows.size())));
  }
  return all;
}

}  // namespace arcslip::studies
