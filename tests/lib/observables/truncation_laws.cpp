// The truncation estimates of random structures with each law of force, against the error that a much higher
// order reports, and, of laws that are piecewise linear, against the exact motion in time.

#include "catch.hpp"
#include "random.hpp"

#include "lib/analyses/branches/same_event.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/observables/in_more_harmonics.hpp"
#include "lib/observables/truncation.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"

#include <iostream>
#include <string>
#include <vector>

using namespace arcslip;
using test_random::Random;

namespace {

constexpr double least_error = 1e-7;  // of amplitudes: errors below are not looked at

std::string number(double value) {
  return std::to_string(value);
}
std::string field(const char* name, double value) {
  return std::string(", \"") + name + "\": " + number(value);
}

/// The keys of an element behind its name.
using Element = std::string (*)(Random& random);

/// A mass of 1 kg and some with others, in a chain, with a random element. The second force, where there is
/// one, acts on the last mass.
scene::Scene structure(Random& random, int masses, bool second_force, Element element) {
  const char* const names[] = {"x", "y", "z"};
  std::string dofs, inertia, springs, dampers;
  for (int i = 0; i < masses; ++i) {
    const std::string comma = i > 0 ? ", " : "", n = std::to_string(i),
                      place = i == 0 ? std::string(R"("at": "x")")
                                     : R"("between": [")" + std::string(names[i - 1]) + R"(", ")" + names[i] +
                                           R"("])";
    dofs += comma + '"' + names[i] + '"';
    inertia += comma + R"({"name": "m)" + n + R"(", "at": ")" + names[i] + R"(", "value": )" +
               number(i == 0 ? 1 : random.logarithmic(0.2, 5)) + "}";
    springs +=
        comma + R"({"name": "k)" + n + R"(", )" + place + field("value", random.logarithmic(0.1, 2)) + "}";
    dampers += comma + R"({"name": "c)" + n + R"(", )" + place +
               field("value", random.logarithmic(0.005, 0.05)) + "}";
  }
  std::string forces = R"({"name": "f", "at": "x")" + field("cosine", random.logarithmic(0.1, 1)) + "}";
  if (second_force)
    forces += std::string(R"(, {"name": "f2", "at": ")") + names[masses - 1] + '"' +
              field("cosine", random.between(-0.5, 0.5)) + field("sine", random.between(-0.5, 0.5)) + "}";
  scene::Scene s = scenes::parse(
      R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": [)" + dofs +
      R"(], "masses": [)" + inertia + R"(], "springs": [)" + springs + R"(], "dampers": [)" + dampers +
      R"(]}, "elements": [{"name": "e", )" + element(random) + R"(}], "excitation": [)" + forces +
      R"(], "response": {"at": "x"}, "studies": [{"kind": "frf", "from": 0.4, "to": 1.8}]})");
  s.harmonics.order = 3 + 2 * random.count(0, 4);
  return s;
}

std::string opening_contact(Random& random) {
  return field("tangential_stiffness", random.logarithmic(0.1, 3)) +
         field("normal_stiffness", random.logarithmic(0.1, 1)) +
         field("friction_coefficient", random.between(0.2, 0.8)) +
         field("normal_load", random.logarithmic(0.1, 3));
}

struct Law {
  std::string name;
  int least_masses;
  bool second_force, exact_in_time;
  Element element;
};

const std::vector<Law>& laws() {
  static const std::vector<Law> all = {
      {"jenkins", 1, false, true,
       [](Random& random) {
         return R"("type": "jenkins", "at": "x", "friction_coefficient": 0.5)" +
                field("stiffness", random.logarithmic(0.1, 3)) +
                field("normal_load", random.logarithmic(0.05, 2));
       }},
      {"coulomb", 1, false, false,
       [](Random& random) {
         return R"("type": "coulomb", "at": "x", "friction_coefficient": 0.5)" +
                field("normal_load", random.logarithmic(0.02, 0.3));
       }},
      {"contact_2d", 2, true, true,
       [](Random& random) {
         return R"("type": "contact_2d", "tangential": {"at": "x"}, "normal": {"at": "y"})" +
                opening_contact(random);
       }},
      {"contact_3d", 3, true, false,
       [](Random& random) {
         return R"("type": "contact_3d", "tangential_1": {"at": "x"}, "tangential_2": {"at": "y"}, "normal": {"at": "z"})" +
                opening_contact(random);
       }},
      {"iwan", 1, false, false,
       [](Random& random) {
         return R"("type": "iwan", "at": "x")" + field("stiffness", random.logarithmic(0.1, 3)) +
                field("slip_force", random.logarithmic(0.05, 2)) +
                (random.one_in(2)
                     ? R"(, "distribution": "four-parameter")" + field("exponent", random.between(-0.8, 0)) +
                           field("beta", random.between(0, 2))
                     : std::string());
       }},
      {"tanh_friction", 1, false, false,
       [](Random& random) {
         return R"("type": "tanh_friction", "at": "x", "friction_coefficient": 0.5)" +
                field("normal_load", random.logarithmic(0.05, 0.5)) +
                field("reference_velocity", random.logarithmic(0.1, 1));
       }},
      {"quadratic_damper", 1, false, false,
       [](Random& random) {
         return R"("type": "quadratic_damper", "at": "x")" +
                field("coefficient", random.logarithmic(0.02, 0.5));
       }},
      {"van_der_pol", 1, false, false,
       [](Random& random) {
         return R"("type": "van_der_pol", "at": "x")" + field("coefficient", random.logarithmic(0.02, 0.3)) +
                field("amplitude", random.logarithmic(0.3, 3));
       }},
      {"cubic_spring", 1, false, false,
       [](Random& random) {
         return R"("type": "cubic_spring", "at": "x")" + field("stiffness", random.logarithmic(0.01, 0.5));
       }},
      {"polynomial_spring", 1, false, false,
       [](Random& random) {
         return R"("type": "polynomial_spring", "at": "x", "coefficients": {"2": )" +
                number(random.between(-0.1, 0.1)) + field("3", random.logarithmic(0.01, 0.3)) + "}";
       }},
      {"polynomial_coupling", 2, true, false,
       [](Random& random) {
         return R"("type": "polynomial_coupling", "potential": [{"powers": {"x": 2, "y": 2})" +
                field("value", random.logarithmic(0.01, 0.3)) + R"(}, {"powers": {"x": 4})" +
                field("value", random.logarithmic(0.01, 0.1)) + "}]";
       }},
      {"gap_spring", 1, false, true,
       [](Random& random) {
         return R"("type": "gap_spring", "at": "x", "two_sided": )" +
                std::string(random.one_in(2) ? "true" : "false") +
                field("stiffness", random.logarithmic(0.1, 5)) + field("gap", random.logarithmic(0.1, 2));
       }},
      {"bilinear_spring", 1, false, true,
       [](Random& random) {
         return R"("type": "bilinear_spring", "at": "x", "one_sided": )" +
                std::string(random.one_in(2) ? "true" : "false") + field("stiffness", random.between(0, 1)) +
                field("stiffness_beyond", random.logarithmic(0.1, 5)) +
                field("corner", random.logarithmic(0.1, 2));
       }},
      {"piecewise_linear_spring", 1, false, true,
       [](Random& random) {
         const double a = random.between(0.2, 1), b = random.between(0.2, 1);
         return R"("type": "piecewise_linear_spring", "at": "x", "table": [[)" + number(-a) + ", " +
                number(-a * random.between(0.1, 2)) + "], [0, 0], [" + number(b) + ", " +
                number(b * random.between(0.1, 2)) + "]]";
       }},
      {"bouc_wen", 1, false, false, [](Random& random) {
         return R"("type": "bouc_wen", "at": "x")" + field("stiffness", random.logarithmic(0.1, 2)) +
                field("elastic_share", random.between(0, 0.5)) +
                field("yield_displacement", random.logarithmic(0.2, 2)) +
                field("exponent", random.between(1, 4)) + field("shape", random.between(0.5, 1));
       }}};
  return all;
}

/// Estimates next to errors.
struct Counts {
  int estimates = 0, low = 0, far_too_low = 0;  // not flagged; below half, and below a tenth of the error

  void add(double estimate, double error, double amplitude) {
    ++estimates;
    if (!(error > least_error * amplitude)) return;
    if (error > 2 * estimate) ++low;
    if (error > 10 * estimate) ++far_too_low;
    if (error > 2 * estimate)
      std::cout << "  error " << error / amplitude << " of the amplitude, estimated as "
                << estimate / amplitude << std::endl;
  }
};

void compare_peaks(const observables::ResponseBranch& branch, const observables::ResponseBranch& higher,
                   Counts& to) {
  for (const auto& event : branch.events) {
    if (event.kind != "peak" || event.point.truncation_flagged) continue;
    if (const auto* exact = same_event::find(event, higher))
      to.add(event.point.truncation_estimate, std::abs(event.point.amplitude - exact->amplitude),
             exact->amplitude);
  }
}

/// Some points of a branch next to the exact motion in time, found from theirs by shooting.
void compare_in_time(const std::shared_ptr<const model::Model>& model,
                     const observables::ResponseBranch& branch, Counts& to) {
  for (std::size_t k = 5; k < branch.points.size(); k += branch.points.size() / 4 + 1) {
    const auto& point = branch.points[k];
    if (point.truncation_flagged) continue;
    const Eigen::Map<const continuation::Vector> u(point.unknowns.data(),
                                                   static_cast<Eigen::Index>(point.unknowns.size()));
    const auto problem = std::make_shared<const hbm::HbmProblem>(model, model->harmonics, u.norm(), 1);
    const continuation::Vector p = hbm::parameters_at(*problem, point.omega);
    const auto equation = time::equation_of_motion(*model, p);
    time::EventDriven integrator(equation);
    const auto exact = time::periodic_motion(integrator, time::state_of(*problem, u, p), {}, {});
    if (!exact.converged()) continue;
    if (std::abs(exact.period.amplitude - point.amplitude) > 0.1 * point.amplitude) continue;  // another one
    to.add(point.truncation_estimate, std::abs(exact.period.amplitude - point.amplitude),
           exact.period.amplitude);
  }
}

/// Of one structure with a law.
void compare(const Law& law, std::uint64_t seed, in_more_harmonics::Compared& points, Counts& peaks,
             Counts& in_time) {
  Random random(seed);
  scene::Scene s = structure(random, random.count(law.least_masses, std::max(2, law.least_masses)),
                             law.second_force, law.element);
  const auto branch = same_event::response(s);
  if (branch.status == observables::Status::failed) return;
  const auto model = std::make_shared<const model::Model>(model::build(s));
  if (law.exact_in_time) compare_in_time(model, branch, in_time);
  s.harmonics.order = 3 * s.harmonics.order + 12;
  in_more_harmonics::compare(std::make_shared<const model::Model>(model::build(s)), model->harmonics, branch,
                             20, least_error, points);
  compare_peaks(branch, same_event::response(s), peaks);
}

}  // namespace

TEST_CASE("truncation estimates of each law are above half of the error, at points and at peaks") {
  in_more_harmonics::Compared points;
  Counts peaks, in_time;
  REQUIRE(laws().size() == truncation::law_count);
  for (const Law& law : laws()) {
    const int before = points.points, in_time_before = in_time.estimates;
    for (std::uint64_t seed = 0; seed < truncation::each_law.count(); ++seed) {
      CAPTURE(law.name, seed);
      compare(law, seed, points, peaks, in_time);
    }
    CAPTURE(law.name);
    CHECK(points.points > before);
    CHECK((in_time.estimates > in_time_before) == law.exact_in_time);
    std::cout << law.name << ": " << points.points << " points, " << points.above_twice << " below half, "
              << points.above_ten_times << " below a tenth, " << points.flagged << " flagged; "
              << peaks.estimates << " peaks, " << peaks.low << ", " << peaks.far_too_low << "; "
              << in_time.estimates << " in time, " << in_time.low << ", " << in_time.far_too_low << std::endl;
  }
  const int estimates = points.points + peaks.estimates + in_time.estimates,
            low = points.above_twice + peaks.low + in_time.low;
  CAPTURE(estimates, low);
  CHECK(1000 * (low - 1) <= estimates);  // one more by chance, where they are few
  CHECK(points.above_ten_times + in_time.far_too_low == 0);
  // A kink at which a contact in a plane begins to slip, and the amplitude falls at once by some 1e-6, may be
  // passed: of 3203 estimates, twice.
  CHECK(1000 * (peaks.far_too_low - 1) <= estimates);
}
