#include <arcslip/output/json.hpp>

#include <arcslip/output/json_members.hpp>
#include <arcslip/output/json_text.hpp>

#include <array>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::output {
namespace {

using detail::Json;
using detail::JsonMembers;
using detail::named_values;
using detail::text;
using observables::ElementResponse;
using observables::ResponseBranch;
using observables::ResponseEvent;
using observables::ResponsePoint;

/// The points and events of a branch, an object a line.
class Rows {
 public:
  Rows(const scene::Scene& scene, const ResponseBranch& branch, const JsonOptions& options)
      : options_(options), unit_(scene::to_rad_per_s(scene.frequency_unit)) {
    if (!branch.over.empty()) {
      over_ = text(branch.over);
    }
  }

  void points(std::ostream& out, const std::vector<ResponsePoint>& points) {
    list(out, points, [&](JsonMembers& members, const ResponsePoint& point) { add(members, point); });
  }

  void events(std::ostream& out, const std::vector<ResponseEvent>& events) {
    list(out, events, [&](JsonMembers& members, const ResponseEvent& event) {
      members.key("kind");
      row_ += text(event.kind);
      members.key("nonsmooth");
      members.value(event.nonsmooth);
      members.key("located");
      members.value(event.located);
      add(members, event.point);
    });
  }

 private:
  template <class List, class Add>
  void list(std::ostream& out, const List& all, const Add& add_to) {
    out << '[';
    const char* separator = "\n";
    for (const auto& each : all) {
      row_.clear();
      JsonMembers members(row_);
      add_to(members, each);
      members.end();
      out << std::exchange(separator, ",\n") << row_;
    }
    out << ']';
  }

  void add(JsonMembers& members, const ResponsePoint& point) {
    if (!over_.empty()) {
      members.escaped_key(over_);
      members.value(point.over);
    }
    members.quantities(observables::response_quantities(), point, unit_);
    members.key("elements");
    JsonMembers elements(row_);
    for (std::size_t e = 0; e < point.elements.size(); ++e) {
      elements.escaped_key(escaped(e, point.elements[e].name));
      JsonMembers element(row_);
      element.quantities(observables::element_quantities(), point.elements[e], unit_);
      element.end();
    }
    elements.end();
    if (options_.coefficients) {
      members.key("coefficients");
      members.value(point.coefficients);
    }
  }

  // The elements are the same at nearly every point.
  const std::string& escaped(std::size_t e, const std::string& name) {
    if (names_.size() <= e) {
      names_.resize(e + 1);
    }
    if (names_[e].plain != name || names_[e].escaped.empty()) {
      names_[e] = {name, text(name)};
    }
    return names_[e].escaped;
  }

  struct Name {
    std::string plain, escaped;
  };
  const JsonOptions& options_;
  double unit_;
  std::string over_, row_;
  std::vector<Name> names_;  // of the elements
};

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
  Rows rows(scene, branch, options);
  out << ",\n\"points\": ";
  rows.points(out, branch.points);
  out << ",\n\"events\": ";
  rows.events(out, branch.events);
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
