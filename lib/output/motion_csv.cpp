#include <arcslip/output/csv_text.hpp>
#include <arcslip/output/motion.hpp>

namespace arcslip::output {
namespace {

using detail::csv_number;
using observables::Motion;

/// Of the elements of the first motion that has any: all motions of a scene have the same.
std::vector<std::string> element_columns(std::span<const Motion> motions) {
  std::vector<std::string> columns;
  for (const Motion& motion : motions) {
    for (const time::ElementHistory& element : motion.history.elements) {
      columns.push_back(element.name + ".displacement (m)");
      columns.push_back(element.name + ".force (N)");
      if (!element.slider.empty()) {
        columns.push_back(element.name + ".slider (m)");
      }
    }
    if (!columns.empty()) {
      break;
    }
  }
  return columns;
}

}  // namespace

void write_csv(std::ostream& out, const scene::Scene& scene, std::span<const Motion> motions) {
  std::vector<std::string> set;
  bool several_studies = false;
  for (const Motion& motion : motions) {
    several_studies = several_studies || motion.study != motions.front().study;
    for (const auto& [name, value] : motion.set) {
      detail::add_name(name, set);
    }
  }
  std::vector<std::string> header(several_studies ? 1 : 0, "study");
  for (const std::string& name : set) {
    header.push_back(with_unit(name, parameter_unit(scene, name)));
  }
  header.insert(header.end(), {"motion", "time (s)", "displacement (m)", "velocity (m/s)"});
  const std::vector<std::string> elements = element_columns(motions);
  header.insert(header.end(), elements.begin(), elements.end());
  detail::write_csv_header(out, header);

  for (std::size_t m = 0; m < motions.size(); ++m) {
    const Motion& motion = motions[m];
    std::vector<std::string> first(several_studies ? 1 : 0, detail::csv_text(motion.study));
    for (const std::string& name : set) {
      std::string value;
      for (const auto* values : {&motion.set, &motion.parameters}) {
        for (const auto& [key, number] : *values) {
          value = key == name ? csv_number(number) : value;
        }
      }
      first.push_back(value);
    }
    first.push_back(std::to_string(m + 1));
    const time::History& history = motion.history;
    for (std::size_t i = 0; i < history.time.size(); ++i) {
      std::vector<std::string> row = first;
      row.insert(row.end(), {csv_number(history.time[i]), csv_number(history.displacement[i]),
                             csv_number(history.velocity[i])});
      for (const time::ElementHistory& element : history.elements) {
        row.push_back(csv_number(element.displacement[i]));
        row.push_back(csv_number(element.force[i]));
        if (!element.slider.empty()) {
          row.push_back(csv_number(element.slider[i]));
        }
      }
      detail::write_csv_row(out, row);
    }
  }
}

}  // namespace arcslip::output
