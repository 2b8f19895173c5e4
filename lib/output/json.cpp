#include <arcslip/output/json.hpp>

#include <arcslip/output/json_text.hpp>
#include <arcslip/output/units.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <utility>

namespace arcslip::output {
namespace {

using detail::Json;
using detail::named_values;
using detail::text;
using detail::write_list;
using observables::ResponseBranch;
using observables::ResponseEvent;
using observables::ResponsePoint;

Json elements(const ResponsePoint& point) {
  Json all = Json::object();
  for (const observables::ElementResponse& element : point.elements) {
    Json& json = all[element.name] = Json::object();
    if (element.has_stick) {
      json["stick_percent"] = element.stick_percent;
      json["slip_angles"] = element.slip_angles;
      json["reversal_angles"] = element.reversal_angles;
    }
    json["energy"] = element.energy;
    if (element.has_stick) {
      json["theta_0"] = element.theta_0;
      json["theta_star"] = element.theta_star;
    }
    json["in_phase"] = element.fundamental.in_phase;
    json["out_of_phase"] = element.fundamental.out_of_phase;
    json["equivalent_stiffness"] = element.equivalent_stiffness;
    json["equivalent_damping"] = element.equivalent_damping;
    if (!std::isnan(element.maxima.force)) {
      json["maxima"] = {
          {"force", element.maxima.force}, {"cosine", element.maxima.cosine}, {"sine", element.maxima.sine}};
    }
  }
  return all;
}

Json force_per_displacement(const ResponsePoint& point) {
  const observables::ForceComponents& forces = point.forces;
  const observables::PhaseParts total = forces.total();
  Json in_phase = {{"total", total.in_phase},
                   {"inertia", forces.inertia},
                   {"spring", forces.spring},
                   {"contact", forces.contact.in_phase}};
  Json out_of_phase = {
      {"total", total.out_of_phase}, {"viscous", forces.viscous}, {"contact", forces.contact.out_of_phase}};
  const auto is_spring = [](const observables::ElementResponse& element) { return !element.has_stick; };
  if (std::any_of(point.elements.begin(), point.elements.end(), is_spring)) {
    in_phase["nonlinear_spring"] = forces.nonlinear_spring.in_phase;
    out_of_phase["nonlinear_spring"] = forces.nonlinear_spring.out_of_phase;
  }
  in_phase["excitation"] = forces.excitation.in_phase;
  out_of_phase["excitation"] = forces.excitation.out_of_phase;
  return {{"in_phase", std::move(in_phase)}, {"out_of_phase", std::move(out_of_phase)}};
}

Json maxima(const observables::MotionMaxima& maxima) {
  Json json = {{"velocity", maxima.velocity}, {"acceleration", maxima.acceleration}};
  if (!std::isnan(maxima.force_per_displacement.in_phase)) {
    json["in_phase"] = maxima.force_per_displacement.in_phase;
    json["out_of_phase"] = maxima.force_per_displacement.out_of_phase;
  }
  return json;
}

/// The point's fields, put after those that `json` has.
Json with_point(Json json, const scene::Scene& scene, const std::string& over, const ResponsePoint& point,
                const JsonOptions& options) {
  if (!over.empty()) {
    json[over] = point.over;
  }
  json["omega"] = point.omega;
  json["frequency"] = in_scene_unit(scene, point.omega);
  const auto known = [&](double value) { return point.unbounded ? Json(nullptr) : Json(value); };
  json["amplitude"] = known(point.amplitude);
  if (point.unbounded) {
    json["unbounded"] = true;
  }
  json["phase"] = known(point.phase);
  json["truncation_estimate"] = known(point.truncation_estimate);
  json["truncation_flagged"] = point.truncation_flagged;
  json["energy_friction"] = known(point.energy_friction);
  json["energy_viscous"] = known(point.energy_viscous);
  json["energy_total"] = known(point.energy_total());
  json["energy_input"] = known(point.energy_input);
  json["friction_percent"] = known(point.friction_percent());
  const auto has_stick = [](const observables::ElementResponse& element) { return element.has_stick; };
  if (std::count_if(point.elements.begin(), point.elements.end(), has_stick) == 1) {
    json["stick_percent"] =
        std::find_if(point.elements.begin(), point.elements.end(), has_stick)->stick_percent;
  }
  if (!point.unbounded) {
    json["force_per_displacement"] = force_per_displacement(point);
  }
  if (!std::isnan(point.maxima.velocity)) {
    json["maxima"] = maxima(point.maxima);
  }
  json["elements"] = elements(point);
  if (options.coefficients) {
    json["coefficients"] = point.coefficients;
  }
  return json;
}

Json solver(const observables::SolverSummary& summary) {
  return {{"linear_solver", summary.linear_solver},
          {"unknowns", summary.unknowns},
          {"points", summary.points},
          {"rejected_steps", summary.rejected_steps},
          {"residuals", summary.residuals},
          {"jacobians", summary.jacobians},
          {"factorizations", summary.factorizations},
          {"solves", summary.solves},
          {"seconds", summary.seconds}};
}

void write_branch(std::ostream& out, const scene::Scene& scene, const ResponseBranch& branch,
                  const JsonOptions& options) {
  out << '{' << detail::origin(branch.study, branch.kind) << "\"status\": \"" << name(branch.status)
      << "\",\n\"stop\": " << text(detail::stop(branch.stop))
      << (branch.over.empty() ? "" : ",\n\"over\": " + text(branch.over))
      << ",\n\"set\": " << text(named_values(branch.set))
      << ",\n\"parameters\": " << text(named_values(branch.parameters));
  if (options.coefficients) {
    out << ",\n\"harmonics\": " << text(branch.harmonics);
  }
  out << ",\n\"points\": ";
  write_list(out, branch.points, [&](const ResponsePoint& point) {
    return with_point(Json::object(), scene, branch.over, point, options);
  });
  out << ",\n\"events\": ";
  write_list(out, branch.events, [&](const ResponseEvent& event) {
    return with_point({{"kind", event.kind}, {"nonsmooth", event.nonsmooth}, {"located", event.located}},
                      scene, branch.over, event.point, options);
  });
  out << ",\n\"solver\": " << text(solver(branch.solver)) << '}';
}

}  // namespace

JsonSection json_section(const scene::Scene& scene, std::span<const ResponseBranch> branches,
                         const JsonOptions& options) {
  return {"arcslip-branches-1", "branches", [&scene, branches, options](std::ostream& out) {
            out << '[';
            const char* separator = "\n";
            for (const ResponseBranch& branch : branches) {
              out << separator;
              write_branch(out, scene, branch, options);
              separator = ",\n";
            }
            out << ']';
          }};
}

void write_json(std::ostream& out, const scene::Scene& scene, std::span<const ResponseBranch> branches,
                const JsonOptions& options) {
  write_document(out, scene, std::array{json_section(scene, branches, options)});
}

}  // namespace arcslip::output
