#pragma once
// f(q) from a table in a file: "q,f" on each line, q rising through 0, linear between and beyond.

#include <arcslip/laws/sampled_law.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace own_laws {

using namespace arcslip;
using elements::Fields, elements::In;

struct TableOptions {
  scene::NamedFile table;
  friend bool operator==(const TableOptions&, const TableOptions&) = default;
};

inline std::vector<std::pair<double, double>> rows_of(const std::string& text) {
  std::vector<std::pair<double, double>> rows;
  std::istringstream in(text);
  char comma = 0;
  for (double q = 0, f = 0; in >> q >> comma >> f;) rows.emplace_back(q, f);
  return rows;
}

/// One field: the factor of all forces.
class TableLaw final : public elements::SampledLaw {
 public:
  explicit TableLaw(const std::string& text) : rows_(rows_of(text)) {}
  std::string_view name() const override { return "table_spring"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return factor; }
  elements::Traits traits(Fields fields, int direction) const override {
    return {.stiffness = stiffness(fields, direction, 0), .holds_mean = true};
  }
  double stiffness(Fields fields, int, double) const override {
    double largest = 0;
    for (std::size_t i = 1; i < rows_.size(); ++i) largest = std::max(largest, slope(i));
    return fields[0] * largest;
  }
  int samples(const elements::Harmonics& h) const override { return 8 * h.order + 8; }
  void sample(Fields fields, const Eigen::MatrixXd& q, elements::SampledForce& at) const override {
    at.piece = 0;
    for (Eigen::Index k = 0; k < q.rows(); ++k) {
      std::size_t i = 1;
      while (i + 1 < rows_.size() && q(k, 0) > rows_[i].first) ++i;
      const double f = rows_[i].second + slope(i) * (q(k, 0) - rows_[i].first);
      at.f(k, 0) = fields[0] * f;
      at.f_q(k, 0) = fields[0] * slope(i);
      at.f_field(k, 0) = f;
    }
  }

  static constexpr scene::Field factor[1] = {{.name = "factor",
                                              .unit = "-",
                                              .lower = 0,
                                              .upper = 1e300,
                                              .default_value = 1,
                                              .help = "of all forces"}};

 private:
  double slope(std::size_t i) const {
    return (rows_[i].second - rows_[i - 1].second) / (rows_[i].first - rows_[i - 1].first);
  }

  std::vector<std::pair<double, double>> rows_;
};

inline scene::file::KeysOf<TableOptions> table_options() {
  scene::file::KeysOf<TableOptions> keys;
  keys.add(scene::file::named_file("table", &TableOptions::table, "a string, the path of a table of q and f",
                                   "forces"));
  keys.check([](const scene::file::Reading& reading, TableOptions& options) {
    if (options.table.text && rows_of(*options.table.text).size() < 2)
      reading.faults.add(reading.keys.find("table").pointer,
                         "found a table of fewer than 2 rows, must be lines \"q,f\"");
  });
  return keys;
}

class TableType final : public scene::file::KeyedPart<TableOptions, elements::LawType> {
 public:
  TableType() : KeyedPart(table_options()) {}
  std::string_view name() const override { return "table_spring"; }
  std::string_view help() const override { return "a spring whose force is a table"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return TableLaw::factor; }
  std::shared_ptr<const elements::Law> law(const scene::Settings& options) const override {
    return std::make_shared<const TableLaw>(*options.as<TableOptions>().table.text);
  }
};

}  // namespace own_laws
