#include <arcslip/output/json_text.hpp>
#include <arcslip/output/motion.hpp>
#include <arcslip/output/units.hpp>

#include <array>
#include <ostream>

namespace arcslip::output {
namespace {

using detail::Json;
using detail::text;
using observables::Motion;

Json elements(const Motion& motion) {
  Json all = Json::object();
  for (const observables::ElementMotion& element : motion.elements) {
    all[element.name] = {{"stick_percent", element.stick_percent}, {"energy", element.energy}};
  }
  return all;
}

Json numbers(const scene::Scene& scene, const Motion& motion) {
  Json json = {{"method", scene::method_name(motion.method)},
               {"integrator", motion.integrator},
               {"frequency", in_scene_unit(scene, motion.omega)},
               {"omega", motion.omega},
               {"steps", motion.steps},
               {"periods", motion.periods},
               {"period_change", motion.change},
               {"amplitude", motion.amplitude},
               {"energy_input", motion.energy.input},
               {"energy_friction", motion.energy.friction},
               {"energy_viscous", motion.energy.viscous},
               {"energy_stored", motion.energy.stored},
               {"energy_defect", motion.energy.defect()}};
  json["multipliers"] = Json::array();
  for (const std::complex<double>& multiplier : motion.multipliers) {
    json["multipliers"].push_back({multiplier.real(), multiplier.imag()});
  }
  if (motion.stable) {
    json["stable"] = *motion.stable;
  }
  if (motion.elements.size() == 1) {
    json["stick_percent"] = motion.elements.front().stick_percent;
  }
  json["elements"] = elements(motion);
  return json;
}

void write_list(std::ostream& out, const char* key, const std::vector<double>& values, const char* before) {
  out << before << '"' << key << "\": [";
  const char* separator = "";
  for (const double value : values) {
    out << separator << text(value);
    separator = ",";
  }
  out << ']';
}

void write_history(std::ostream& out, const time::History& history) {
  write_list(out, "time", history.time, "{");
  write_list(out, "displacement", history.displacement, ",\n");
  write_list(out, "velocity", history.velocity, ",\n");
  out << ",\n\"elements\": {";
  const char* separator = "\n";
  for (const time::ElementHistory& element : history.elements) {
    out << separator << text(element.name) << ": ";
    write_list(out, "displacement", element.displacement, "{");
    write_list(out, "force", element.force, ",\n");
    if (!element.slider.empty()) {
      write_list(out, "slider", element.slider, ",\n");
    }
    out << '}';
    separator = ",\n";
  }
  out << "}}";
}

void write_motion(std::ostream& out, const scene::Scene& scene, const Motion& motion) {
  const std::string all = text(numbers(scene, motion));
  out << '{' << detail::origin(motion.study, motion.kind) << "\"status\": \"" << name(motion.status)
      << "\",\n\"stop\": " << text(detail::stop(motion.stop))
      << ",\n\"set\": " << text(detail::named_values(motion.set))
      << ",\n\"parameters\": " << text(detail::named_values(motion.parameters)) << ",\n"
      << all.substr(1, all.size() - 2) << ",\n\"history\": ";
  write_history(out, motion.history);
  out << '}';
}

}  // namespace

JsonSection json_section(const scene::Scene& scene, std::span<const Motion> motions) {
  return {"arcslip-time-1", "motions", [&scene, motions](std::ostream& out) {
            out << '[';
            const char* separator = "\n";
            for (const Motion& motion : motions) {
              out << separator;
              write_motion(out, scene, motion);
              separator = ",\n";
            }
            out << ']';
          }};
}

void write_json(std::ostream& out, const scene::Scene& scene, std::span<const Motion> motions) {
  write_document(out, scene, std::array{json_section(scene, motions)});
}

}  // namespace arcslip::output
