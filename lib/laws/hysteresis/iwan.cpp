#include <arcslip/laws/hysteresis/iwan.hpp>

#include <arcslip/laws/hysteresis/iwan_power_law.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/hysteresis/masing_element.hpp>
#include <arcslip/laws/offset_option.hpp>
#include <arcslip/laws/sampled_automata.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {
namespace {

namespace file = scene::file;

constexpr std::size_t most_sliders = 10000;

enum class Distribution { uniform, four_parameter, table };

constexpr std::array<file::Word<Distribution>, 3> distributions = {
    {{"uniform", Distribution::uniform},
     {"four-parameter", Distribution::four_parameter},
     {"table", Distribution::table}}};

struct IwanOptions {
  Distribution distribution = Distribution::uniform;
  std::vector<IwanSlider> table;
  int sliders = 100;
  friend bool operator==(const IwanOptions&, const IwanOptions&) = default;
};

constexpr scene::Field power_law_fields[] = {
    {.name = "stiffness",
     .unit = "N/m",
     .lower = 0,
     .upper = infinity,
     .lower_open = true,
     .help = "tangential stiffness of small motions, K_T"},
    {.name = "slip_force", .unit = "N", .lower = 0, .upper = infinity, .help = "force of macroslip, F_S"},
    {.name = "exponent",
     .unit = "-",
     .lower = -1,
     .upper = 0,
     .lower_open = true,
     .help = "chi: in microslip the dissipation grows as amplitude^(3 + chi)"},
    {.name = "beta",
     .unit = "-",
     .lower = 0,
     .upper = infinity,
     .help = "stiffness of the sliders that slip together at macroslip, over that of the others"},
};
constexpr scene::Field table_fields[] = {
    {.name = "stiffness_factor",
     .unit = "-",
     .lower = 0,
     .upper = infinity,
     .lower_open = true,
     .default_value = 1,
     .help = "multiplies every stiffness of the table"},
    {.name = "slip_factor",
     .unit = "-",
     .lower = 0,
     .upper = infinity,
     .default_value = 1,
     .help = "multiplies every slip limit of the table, as the normal load does"},
};

std::span<const scene::Field> fields_of(Distribution distribution) {
  if (distribution == Distribution::table) return table_fields;
  return std::span(power_law_fields).first(distribution == Distribution::uniform ? 2 : 4);
}

// "table": [[stiffness, slip limit], ...].
file::KeyGroup<IwanOptions> table_key() {
  const std::string wanted =
      "a list of 1 to " + std::to_string(most_sliders) + " pairs [stiffness, slip limit], each above 0";
  scene::Key key{"table",
                 scene::KeyType::other,
                 "",
                 wanted,
                 "",
                 false,
                 "the sliders, in N/m and N, if \"distribution\" is \"table\""};
  key.schema =
      R"({"type": "array", "minItems": 1, "maxItems": 10000, "items": {"type": "array", "minItems": 2,
    "maxItems": 2, "items": {"type": "number", "exclusiveMinimum": 0}}})";
  const auto read = [wanted](const file::Reading& reading, IwanOptions& options) {
    const file::Location place = options.distribution == Distribution::table
                                     ? reading.keys.require("table", wanted, reading.faults)
                                     : reading.keys.find("table");
    if (place.node != nullptr && options.distribution != Distribution::table) {
      reading.faults.add(place.pointer, "found a table next to another \"distribution\" than \"table\"");
      return;
    }
    const file::Node::List* rows = file::read_list(place, wanted, reading.faults);
    if (rows == nullptr) return;
    if (rows->empty() || rows->size() > most_sliders)
      reading.faults.add(place.pointer,
                         "found " + std::to_string(rows->size()) + " sliders, must be " + wanted);
    for (std::size_t i = 0; i < rows->size(); ++i) {
      const file::Location item{&(*rows)[i], file::child(place.pointer, i)};
      const file::Node::List* pair = file::read_list(item, "a pair [stiffness, slip limit]", reading.faults);
      if (pair == nullptr) continue;
      if (pair->size() != 2) {
        reading.faults.add(item.pointer, "found " + std::to_string(pair->size()) +
                                             " numbers, must be a pair [stiffness, slip limit]");
        continue;
      }
      double values[2] = {1, 1};
      for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
        const scene::Field above_0{.name = k == 0 ? "stiffness" : "slip limit",
                                   .unit = k == 0 ? "N/m" : "N",
                                   .lower = 0,
                                   .upper = infinity,
                                   .lower_open = true};
        const file::Location at{&(*pair)[k], file::child(item.pointer, k)};
        values[k] = file::read_number(at, above_0, reading.faults).value_or(1);
      }
      options.table.emplace_back(values[0], values[1]);
    }
  };
  const auto write = [](const IwanOptions& options, const scene::Scene&, file::Node::Object& to) {
    if (options.table.empty()) return;
    file::Node::List rows;
    for (const auto& [stiffness, limit] : options.table)
      rows.push_back(file::node(std::vector{stiffness, limit}));
    to.push_back({"table", file::Node{std::move(rows)}});
  };
  return {{key}, read, write};
}

file::KeysOf<IwanOptions> iwan_keys() {
  file::KeysOf<IwanOptions> keys;
  keys.add(file::word("distribution", &IwanOptions::distribution, distributions, "of slip limits"));
  keys.add(table_key());
  keys.add(
      file::whole("sliders", &IwanOptions::sliders, 2, static_cast<int>(most_sliders),
                  "number of sliders by which studies of kind \"time\" replace a continuous distribution"));
  keys.add(centred_offset<IwanOptions>(
      "where sliders that never slip rest, as some do in microslip: without a mean force",
      "which this joint does not have: its sliders that stick throughout the period, as some do in "
      "microslip, "
      "hold no mean force; where one is to be held, put elements of type \"jenkins\" with \"offset\": "
      "\"static\" in parallel"));
  return keys;
}

class Iwan final : public Law {
 public:
  explicit Iwan(IwanOptions options) : options_(std::move(options)) {}

  Facts facts() const override {
    return {.antisymmetric = true,
            .contact = true,
            .dissipative = true,
            .memory = is_table() ? static_cast<int>(options_.table.size()) : options_.sliders};
  }
  Traits traits(Fields fields, int) const override {
    const auto [stiffness, slip_force] = sums(fields);
    return {.stiffness = stiffness,
            .stiffness_field = is_table() ? -1 : 0,
            .far_work = 4 * slip_force,
            .limit = slip_force};
  }
  double stiffness(Fields fields, int, double) const override { return sums(fields).first; }
  bool limited_by(int field) const override { return field == 1; }

  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling& sampling) const override {
    if (!sampling.exact) return sampled_automata(*this, harmonics, sampling.samples);
    return masing(harmonics);
  }
  std::unique_ptr<Corners> corners(const Harmonics& harmonics) const override {
    return make_iwan_corners(harmonics, is_table() ? onsets_of_table() : onsets_of_power_law());
  }
  Eigen::MatrixXd force_at(const Harmonics& h, In u, Fields fields, Angles angles) const override {
    Eigen::MatrixXd f(static_cast<Eigen::Index>(angles.size()), 1);
    masing(h)->force_at(u, fields, angles, f.col(0));
    return f;
  }

  std::optional<std::vector<Automaton>> automata(Fields fields) const override {
    std::vector<Automaton> all;
    each(fields, [&](int j, double k, double p) {
      all.push_back(jenkins_automaton(j, k, p));
      all.back().weight = k;
    });
    return all;
  }

 private:
  bool is_table() const { return options_.distribution == Distribution::table; }
  bool is_uniform() const { return options_.distribution == Distribution::uniform; }

  std::unique_ptr<MasingElement> masing(const Harmonics& harmonics) const {
    return is_table() ? make_iwan_table(harmonics, options_.table)
                      : make_iwan_power_law(harmonics, is_uniform());
  }

  IwanOnsets onsets_of_table() const {
    double stiffness = 0;
    std::vector<double> limits;  // of the displacement
    for (const auto& [k, p] : options_.table) {
      stiffness += k;
      limits.push_back(p / k);
    }
    std::sort(limits.begin(), limits.end());
    return {static_cast<int>(limits.size()), 2, false, [=](Fields fields) { return fields[0] * stiffness; },
            [=](Fields fields, int j, Eigen::VectorXd& by_field) {
              by_field[0] = 0;
              by_field[1] = stiffness * limits[static_cast<std::size_t>(j)];
              return fields[1] * by_field[1];
            }};
  }

  // Those that slip together at macroslip.
  IwanOnsets onsets_of_power_law() const {
    const auto stiffness = [](Fields fields) { return fields[0]; };
    if (is_uniform()) return {0, 2, true, stiffness, [](Fields, int, Eigen::VectorXd&) { return 0.0; }};
    return {1, 4, true, stiffness, [](Fields fields, int, Eigen::VectorXd& by_field) {
              const PowerLaw law(fields[2], fields[3]);
              by_field << 0, law.largest(), fields[1] * law.largest_by_chi(),
                  fields[1] * law.largest_by_beta();
              return fields[3] > 0 ? fields[1] * law.largest() : 0;
            }};
  }

  // Stiffness of small motions and force of macroslip.
  std::pair<double, double> sums(Fields fields) const {
    std::pair<double, double> sum{fields[0], fields[1]};
    if (!is_table()) return sum;
    sum = {0, 0};
    for (const auto& [stiffness, limit] : options_.table) {
      sum.first += fields[0] * stiffness;
      sum.second += fields[1] * limit;
    }
    return sum;
  }

  // Calls slider(index, stiffness, slip limit) for each. Those of a power law take ranges of slip limits, the
  // narrower the smaller, as these slip in small motions, and of about equal stiffness where chi is near -1;
  // what slips at macroslip is the last.
  template <class Visitor>
  void each(Fields fields, Visitor&& slider) const {
    if (is_table()) {
      for (std::size_t j = 0; j < options_.table.size(); ++j)
        slider(static_cast<int>(j), fields[0] * options_.table[j].first,
               fields[1] * options_.table[j].second);
      return;
    }
    const PowerLaw law = is_uniform() ? PowerLaw(0, 0) : PowerLaw(fields[2], fields[3]);
    const auto call = [&](int j, const PowerLaw::Share& share) {
      slider(j, fields[0] * share.stiffness, fields[1] * share.slip_force);
    };
    const int ranges = is_uniform() ? options_.sliders : options_.sliders - 1;
    const double power = is_uniform() ? 2 : std::max(2.0, 1 / (1 + fields[2]));
    const auto end = [&](int j) { return std::pow(static_cast<double>(j) / ranges, power); };
    for (int j = 0; j < ranges; ++j) call(j, law.between(end(j), end(j + 1)));
    if (!is_uniform()) call(ranges, law.at_most());
  }

  IwanOptions options_;
};

class IwanType final : public file::KeyedPart<IwanOptions, LawType> {
 public:
  IwanType() : KeyedPart(iwan_keys()) {}
  std::string_view name() const override { return "iwan"; }
  std::string_view help() const override {
    return "sliders with springs in parallel, of distributed slip limits (Iwan): microslip and macroslip";
  }
  std::span<const scene::Field> fields(const scene::Settings& options) const override {
    return fields_of(of(options).distribution);
  }
  std::shared_ptr<const Law> law(const scene::Settings& options) const override {
    return std::make_shared<const Iwan>(of(options));
  }

 private:
  static IwanOptions of(const scene::Settings& options) {
    return options.empty() ? IwanOptions{} : options.as<IwanOptions>();
  }
};

}  // namespace

const LawType& iwan() {
  static const IwanType type;
  return type;
}

}  // namespace arcslip::elements
