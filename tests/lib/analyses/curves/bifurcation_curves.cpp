// Curves of bifurcations in two parameters, compared with shooting in this test, closed forms and
// invariances.
#include "catch.hpp"
#include "controls.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/laws/contact/contacts.hpp"

#include <arcslip/analyses/curves/bifurcations.hpp>
#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

using namespace arcslip;
using observables::BifurcationsOf;
using observables::ResponseBranch;
using observables::ResponseEvent;
using observables::ResponsePoint;

namespace {

constexpr double pi = std::numbers::pi;

std::vector<ResponseEvent> events(const ResponseBranch& branch, const std::string& kind) {
  std::vector<ResponseEvent> found;
  for (const auto& event : branch.events)
    if (event.kind == kind) found.push_back(event);
  return found;
}

scene::Scene oscillator(const std::string& elements, double k, double c, double force, int order) {
  auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 1}]},
    "elements": [)" + elements +
                         R"(],
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "response": {"at": "x"}})");
  scene::set(s, "k.value", k);
  scene::set(s, "c.value", c);
  scene::set(s, "f.cosine", force);
  s.harmonics.order = order;
  return s;
}

// NLvib, example 03; pad: a friction damper between mass 2 and the ground, of this normal load.
scene::Scene masses_and_stop(int order, double pad = 0) {
  auto s = scenes::parse(
      R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x1", "x2"],
      "masses": [{"name": "m1", "at": "x1", "value": 1}, {"name": "m2", "at": "x2", "value": 1}],
      "springs": [{"name": "k12", "between": ["x1", "x2"], "value": 1}, {"name": "k2", "at": "x2", "value": 1}],
      "dampers": [{"name": "c12", "between": ["x1", "x2"], "value": 0.03},
                  {"name": "c2", "at": "x2", "value": 0.03}]},
    "elements": [{"name": "stop", "type": "gap_spring", "at": "x1", "stiffness": 100, "gap": 1})" +
      std::string(pad > 0 ? R"(, {"name": "pad", "type": "jenkins", "at": "x2", "stiffness": 0.1,
      "friction_coefficient": 1, "normal_load": 1})"
                          : "") +
      R"(],
    "excitation": [{"name": "force", "at": "x2", "cosine": 0.1}], "response": {"at": "x1"}})");
  if (pad > 0) scene::set(s, "pad.normal_load", pad);
  s.harmonics.order = order;
  return s;
}

// x'' + 0.3 x' - x + x^3 about x = 1: 2 y + 3 y^2 + y^3.
scene::Scene double_well(int order) {
  return oscillator(
      R"({"name": "s", "type": "polynomial_spring", "at": "x", "coefficients": {"2": 3, "3": 1}})", 2, 0.3,
      0.1, order);
}

// x'' + x + 0.3 x^2 + 0.2 x^3 + 0.4 (x^2 - 1) x' = F cos w t; antisymmetric: without 0.3 x^2.
scene::Scene van_der_pol(int order, bool antisymmetric = false) {
  const std::string spring = antisymmetric
                                 ? R"({"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 0.2})"
                                 : R"({"name": "s", "type": "polynomial_spring", "at": "x",
    "coefficients": {"2": 0.3, "3": 0.2}})";
  return oscillator(
      spring + R"(, {"name": "v", "type": "van_der_pol", "at": "x", "coefficient": 0.4, "amplitude": 1})", 1,
      0, 1, order);
}

// By Runge-Kutta steps of fourth order: a periodic motion of x'' = a(x, x') + F cos w t and a condition of
// its monodromy matrix M. Unknowns x, x' at t = 0, F and w; by Newton's method with differences.
struct Shooting {
  using State = std::array<double, 6>;                                // x, x', columns of M
  using Unknowns = Eigen::Vector4d;                                   // x, x', F, w
  std::function<double(double x, double v)> force;                    // -a
  std::function<std::array<double, 2>(double x, double v)> gradient;  // of -a

  State map(const Unknowns& z) const {
    const auto rate = [&](double t, const State& y) {
      const auto [k, c] = gradient(y[0], y[1]);
      return State{y[1], z[2] * std::cos(z[3] * t) - force(y[0], y[1]),
                   y[3], -k * y[2] - c * y[3],
                   y[5], -k * y[4] - c * y[5]};
    };
    const auto plus = [](const State& a, double factor, const State& b) {
      State sum = a;
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * b[i];
      return sum;
    };
    constexpr int steps = 1500;
    const double h = 2 * pi / z[3] / steps;
    State y{z[0], z[1], 1, 0, 0, 1};
    for (int i = 0; i < steps; ++i) {
      const double t = i * h;
      const State k1 = rate(t, y), k2 = rate(t + h / 2, plus(y, h / 2, k1)),
                  k3 = rate(t + h / 2, plus(y, h / 2, k2)), k4 = rate(t + h, plus(y, h, k3));
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += h / 6 * (k1[k] + 2 * k2[k] + 2 * k3[k] + k4[k]);
    }
    return y;
  }

  // conditions(tr M, det M, z): two equations.
  using Conditions =
      std::function<std::array<double, 2>(double trace, double determinant, const Unknowns& z)>;
  Unknowns solve(Unknowns z, const Conditions& conditions) const {
    const auto defect = [&](const Unknowns& at) {
      const State y = map(at);
      const auto [a, b] = conditions(y[2] + y[5], y[2] * y[5] - y[3] * y[4], at);
      return Eigen::Vector4d(y[0] - at[0], y[1] - at[1], a, b);
    };
    for (int i = 0; i < 8; ++i) {
      Eigen::Matrix4d J;
      for (int k = 0; k < 4; ++k) {
        const Eigen::Vector4d h = 1e-5 * Eigen::Vector4d::Unit(k);
        J.col(k) = (defect(z + h) - defect(z - h)) / 2e-5;
      }
      const Eigen::Vector4d step = J.lu().solve(defect(z));
      z -= step;
      if (step.norm() < 1e-11) break;
    }
    return z;
  }
};

Shooting of_double_well() {
  return {[](double x, double v) { return 0.3 * v - x + x * x * x; },
          [](double x, double) { return std::array{3 * x * x - 1, 0.3}; }};
}

Shooting of_van_der_pol() {
  return {[](double x, double v) { return x + 0.3 * x * x + 0.2 * x * x * x + 0.4 * (x * x - 1) * v; },
          [](double x, double v) {
            return std::array{1 + 0.6 * x + 0.6 * x * x + 0.8 * x * v, 0.4 * (x * x - 1)};
          }};
}

// (x, x', F, w) at t = 0 of a point of a curve over the force; x_0 is added to x.
Shooting::Unknowns at_start(const ResponsePoint& point, const std::vector<int>& harmonics, double x_0 = 0) {
  double x = x_0, v = 0;
  for (std::size_t i = 0; i < harmonics.size(); ++i) {
    x += point.coefficients[2 * i];
    v += harmonics[i] * point.omega * point.coefficients[2 * i + 1];
  }
  return {x, v, point.over, point.omega};
}

double mean_square(const ResponsePoint& point, const std::vector<int>& harmonics) {
  double sum = 0;
  for (std::size_t i = 0; i < harmonics.size(); ++i) {
    const double a = point.coefficients[2 * i], b = point.coefficients[2 * i + 1];
    sum += harmonics[i] == 0 ? a * a : 0.5 * (a * a + b * b);
  }
  return sum;
}

double nearest_to(std::complex<double> value, const std::vector<std::complex<double>>& all) {
  double nearest = INFINITY;
  for (const auto& each : all) nearest = std::min(nearest, std::abs(each - value));
  return nearest;
}

std::vector<ResponseBranch> curves(const scene::Scene& s, const observables::BifurcationRange& range) {
  return observables::bifurcation_curves(s, range);
}

// Those of one kind.
std::vector<ResponseBranch> of(const std::vector<ResponseBranch>& branches, const std::string& kind) {
  std::vector<ResponseBranch> found;
  for (const auto& branch : branches)
    if (branch.of == kind) found.push_back(branch);
  return found;
}

// The multipliers of each point are where its bifurcation is.
void check_multipliers(const ResponseBranch& branch, double tolerance) {
  for (const auto& point : branch.points) {
    REQUIRE(point.stability);
    const auto& all = point.stability->multipliers;
    if (branch.of == "period_doubling") CHECK(nearest_to(-1, all) < tolerance);
    if (branch.of == "symmetry_breaking") CHECK(nearest_to(1, all) < tolerance);
    if (branch.of == "neimark_sacker")
      CHECK(nearest_to(std::polar(1.0, 2 * pi * point.stability->rotation), all) < tolerance);
  }
}

}  // namespace

TEST_CASE("period doublings of the double well over the force lie where shooting finds them") {
  const Shooting exact = of_double_well();
  const auto doubling_at = [&](double w, const Shooting::Unknowns& near) {
    return exact.solve(near, [&](double trace, double determinant, const auto& at) {
      return std::array{1 + trace + determinant, at[3] - w};
    });
  };
  // The point known from elsewhere.
  CHECK(std::abs(doubling_at(1.2, {0.4075754662, 0.3226140050, 0.2656, 1.2})[2] - 0.265581786056) < 1e-10);
  const auto found = curves(double_well(30), {BifurcationsOf::all, "f.cosine", 0.22, 0.4, 1, 2});
  REQUIRE(found.size() == 1);
  const ResponseBranch& curve = found[0];
  CAPTURE(curve.stop.message);
  CHECK(curve.status == observables::Status::complete);
  CHECK(curve.of == "period_doubling");
  CHECK(curve.over == "f.cosine");
  CHECK(curve.events.size() == 2);
  CHECK(events(curve, "period_doubling").size() == 2);  // its ends
  check_multipliers(curve, 1e-7);
  int compared = 0;
  for (std::size_t i = 0; i < curve.points.size(); i += 20) {
    const auto& point = curve.points[i];
    CHECK(std::abs(doubling_at(point.omega, at_start(point, curve.harmonics, 1))[2] - point.over) < 1e-8);
    ++compared;
  }
  CHECK(compared >= 7);
}

TEST_CASE("a curve of period doublings turns in the force where two of the frequency response meet") {
  const auto found =
      curves(double_well(30), {BifurcationsOf::period_doubling, "f.cosine", 0.2, 0.21, 0.5, 1.2});
  REQUIRE(found.size() == 1);
  CAPTURE(found[0].stop.message);
  CHECK(found[0].status == observables::Status::complete);
  CHECK(found[0].points.front().over == 0.21);
  CHECK(found[0].points.back().over == 0.21);
  const auto turns = events(found[0], "fold");
  REQUIRE(turns.size() == 1);
  for (const double nearby : {-1e-4, 1e-4}) {
    auto s = double_well(30);
    scene::set(s, "f.cosine", turns[0].point.over + nearby);
    const auto response = observables::frequency_response(s, {0.5, 1.2, true});
    CHECK(events(response.at(0), "period_doubling").size() == (nearby < 0 ? 0 : 2));
  }
}

TEST_CASE("Neimark-Sacker points of a van der Pol oscillator are where its damping vanishes in the mean") {
  // Liouville: det M = exp(-0.4 int (x^2 - 1) dt) = 1.
  const auto found = curves(van_der_pol(24), {BifurcationsOf::all, "f.cosine", 6, 0.85, 1, 3.4});
  const auto tori = of(found, "neimark_sacker");
  REQUIRE(tori.size() == 1);
  const ResponseBranch& curve = tori[0];
  CAPTURE(curve.stop.message);
  CHECK(curve.status == observables::Status::complete);
  check_multipliers(curve, 1e-6);
  for (const auto& point : curve.points) {
    CHECK(std::abs(mean_square(point, curve.harmonics) - 1) < 1e-9);
    CHECK(point.stability->unstable == 0);
  }
  // Strong resonances, compared with shooting for det M = 1 and the trace.
  const Shooting exact = of_van_der_pol();
  const struct {
    const char* kind;
    double kappa;
  } resonances[] = {
      {"resonance_1_1", 1}, {"resonance_1_2", -1}, {"resonance_1_3", -0.5}, {"resonance_1_4", 0}};
  for (const auto& [kind, kappa] : resonances) {
    CAPTURE(kind);
    const auto at = events(curve, kind);
    REQUIRE(at.size() == 1);
    const auto& point = at[0].point;
    CHECK(std::abs(std::cos(2 * pi * point.stability->rotation) - kappa) < 1e-10);
    const auto z = exact.solve(at_start(point, curve.harmonics),
                               [&, kappa = kappa](double trace, double determinant, const auto&) {
                                 return std::array{trace - 2 * kappa, determinant - 1};
                               });
    CHECK(std::abs(z[2] - point.over) < 1e-8);
    CHECK(std::abs(z[3] - point.omega) < 1e-8);
  }
}

TEST_CASE("curves of Neimark-Sacker points end on those of folds and of period doublings") {
  const auto s = van_der_pol(24);
  const auto found = curves(s, {BifurcationsOf::all, "f.cosine", 0.85, 6, 1, 3.4});
  const auto tori = of(found, "neimark_sacker"), doublings = of(found, "period_doubling");
  REQUIRE(tori.size() == 1);
  REQUIRE(doublings.size() == 1);
  const auto& end = tori[0].stop;
  CAPTURE(end.message);
  CHECK(end.reason == observables::reasons::resonance);
  CHECK(
      end.message.find("at its start, the pair of multipliers becomes real at 1, a resonance 1:1: the curve "
                       "ends on one of folds, at f.cosine = ") == 0);
  CHECK(
      end.message.find("; at its end, the pair of multipliers becomes real at -1, a resonance 1:2: the curve "
                       "ends on one of period doublings, at f.cosine = ") != std::string::npos);
  // The same point lies on both curves.
  const auto end_of_tori = events(tori[0], "resonance_1_2"),
             on_doublings = events(doublings[0], "resonance_1_2");
  REQUIRE(end_of_tori.size() == 1);
  REQUIRE(on_doublings.size() >= 1);
  CHECK(std::abs(end_of_tori[0].point.over - on_doublings[0].point.over) < 1e-7);
  CHECK(std::abs(end_of_tori[0].point.omega - on_doublings[0].point.omega) < 1e-7);
  // So does the other end, on the curve of folds.
  const auto begin = events(tori[0], "resonance_1_1");
  REQUIRE(begin.size() == 1);
  const double force = begin[0].point.over, w = begin[0].point.omega;
  const auto folds = observables::fold_curves(s, {"f.cosine", force - 0.01, force + 0.01, w - 0.2, w + 0.2});
  double nearest = INFINITY;
  for (const auto& curve : folds)
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      const auto &a = curve.points[i - 1], &b = curve.points[i];
      if ((a.over - force) * (b.over - force) > 0) continue;
      const double share = (force - a.over) / (b.over - a.over);
      nearest = std::min(nearest, std::abs(a.omega + share * (b.omega - a.omega) - w));
    }
  CHECK(nearest < 1e-5);  // of the chord
}

TEST_CASE("an antisymmetric motion has the resonances of half a period, and breaks its symmetry there") {
  const auto found = curves(van_der_pol(15, true), {BifurcationsOf::all, "f.cosine", 4, 1.02, 1.2, 2.5});
  const auto tori = of(found, "neimark_sacker");
  CHECK(of(found, "period_doubling").empty());
  REQUIRE(tori.size() == 1);
  CAPTURE(tori[0].stop.message);
  for (const auto& point : tori[0].points) CHECK(std::abs(mean_square(point, tori[0].harmonics) - 1) < 1e-9);
  const auto end = events(tori[0], "resonance_1_1");
  REQUIRE(end.size() == 1);
  CHECK(tori[0].stop.message.find("becomes real at 1, of the map over half a period") != std::string::npos);
  CHECK(end[0].point.stability->rotation < 1e-6);
}

TEST_CASE("symmetry breaks along a curve on which the Jacobian in even harmonics is singular") {
  const auto s =
      oscillator(R"({"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 1})", 1, 0.1, 3, 21);
  const auto found = curves(s, {BifurcationsOf::all, "f.cosine", 2, 4, 0.5, 1.5});
  REQUIRE_FALSE(found.empty());
  auto scene_at = s;
  int compared = 0;
  for (const auto& curve : found) {
    CAPTURE(curve.stop.message);
    CHECK(curve.status == observables::Status::complete);
    CHECK(curve.of == "symmetry_breaking");
    check_multipliers(curve, 1e-7);
    for (std::size_t i = 0; i < curve.points.size(); i += 10) {
      const auto& point = curve.points[i];
      scene::set(scene_at, "f.cosine", point.over);
      const auto model = std::make_shared<const model::Model>(model::build(scene_at));
      const hbm::HbmProblem odd(model, model->harmonics, 1, 1);
      REQUIRE(odd.harmonics().odd);
      const hbm::HbmProblem all(odd, elements::Harmonics{21}, {});
      double determinant[2];
      for (int side = 0; side < 2; ++side) {
        const auto p = hbm::parameters_at(odd, point.omega + (side == 0 ? -1e-7 : 1e-7));
        const continuation::Vector guess =
            Eigen::Map<const continuation::Vector>(point.unknowns.data(), odd.size());
        const auto u = hbm::response_near(odd, p, guess);
        REQUIRE(u);
        continuation::Vector wide(all.size());
        elements::transfer(odd.harmonics(), *u, all.harmonics(), wide);
        const auto at = all.hbm_evaluator();
        REQUIRE(at->move_to(wide, p, continuation::Needs::jacobian) == continuation::Evaluated::ok);
        determinant[side] = std::get<Eigen::MatrixXd>(at->jacobian()).partialPivLu().determinant();
      }
      CHECK(determinant[0] * determinant[1] < 0);
      ++compared;
    }
  }
  CHECK(compared > 5);
}

TEST_CASE("bifurcations of two masses and a stop move with the force as they do with the gap") {
  // The force F with the gap g has the motion of F/g with the gap 1, times g.
  const auto s = masses_and_stop(30);
  const auto over_gap = curves(s, {BifurcationsOf::all, "stop.gap", 1, 1.25, 0.6, 0.77});
  const auto over_force = curves(s, {BifurcationsOf::all, "force.cosine", 0.1, 0.08, 0.6, 0.77});
  for (const char* kind : {"period_doubling", "neimark_sacker"}) {
    const auto a = of(over_gap, kind), b = of(over_force, kind);
    CAPTURE(kind);
    REQUIRE_FALSE(a.empty());
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      CAPTURE(a[i].stop.message, b[i].stop.message);
      CHECK(a[i].status == observables::Status::complete);
      check_multipliers(a[i], 1e-6);
      for (const bool first : {true, false}) {
        const auto &p = first ? a[i].points.front() : a[i].points.back(),
                   &q = first ? b[i].points.front() : b[i].points.back();
        CHECK(std::abs(q.over - 0.1 / p.over) < 1e-9);
        CHECK(std::abs(p.omega - q.omega) < 1e-9);
        CHECK(std::abs(p.amplitude - p.over * q.amplitude) < 1e-8);
      }
    }
  }
}

TEST_CASE("a curve of period doublings ends where the multipliers jump at the birth of slip, and says so") {
  auto s =
      oscillator(R"({"name": "s", "type": "polynomial_spring", "at": "x", "coefficients": {"2": 3, "3": 1}},
    {"name": "pad", "type": "jenkins", "at": "x", "stiffness": 0.05, "friction_coefficient": 1, "normal_load": 0.02})",
                 2, 0.3, 0.1, 12);
  const auto found = curves(s, {BifurcationsOf::period_doubling, "f.cosine", 0.57, 0.6, 1.5, 1.9});
  const auto ended = std::find_if(found.begin(), found.end(), [](const ResponseBranch& branch) {
    return branch.stop.reason == observables::reasons::jump;
  });
  REQUIRE(ended != found.end());
  CHECK(ended->status == observables::Status::complete);
  CHECK(ended->stop.message.find("the multipliers jump by ") != std::string::npos);
  for (const auto& branch : found) check_multipliers(branch, 1e-6);
}

TEST_CASE("curves whose multipliers are not known, or which are not there, say so") {
  auto s = contacts::plane_pad(5, 25, 8);
  s.masses[0].values[0] = 0;
  const auto unknown = curves(s, {BifurcationsOf::all, "f_a.cosine", 20, 30, 60, 75});
  REQUIRE(unknown.size() == 1);
  CHECK(unknown[0].status == observables::Status::failed);
  CHECK(unknown[0].stop.reason == observables::reasons::start_failed);
  CHECK(unknown[0].stop.message ==
        "no bifurcation was found at f_a.cosine = 20, nor up to 30, between 60 rad/s and 75 rad/s: the "
        "stability of the response at f_a.cosine = 20 is not known, and curves may be missing: degree of "
        "freedom \"a\" has no mass of its own (M is singular)");
  const auto none =
      curves(double_well(9), {BifurcationsOf::neimark_sacker, "f.cosine", 0.01, 0.02, 0.9, 1.1});
  REQUIRE(none.size() == 1);
  CHECK(none[0].stop.message ==
        "no Neimark-Sacker point was found at f.cosine = 0.01, nor up to 0.02, between 0.9 rad/s and 1.1 "
        "rad/s: the branch that begins at 0.9 rad/s was looked at, for 9 values of f.cosine, and no other "
        "(\"branches\": \"all\")");
  CHECK(none[0].untraced.empty());
}

namespace {

scene::Scene hardening_duffing() {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "nl", "type": "cubic_spring", "at": "x", "stiffness": 1}],
    "excitation": [{"name": "force", "at": "x", "cosine": 20}], "response": {"at": "x"},
    "harmonics": {"order": 21}})");
}

}  // namespace

TEST_CASE("motions that leave antisymmetric ones at a break of symmetry double their period", "[numbers]") {
  const scene::Scene s = hardening_duffing();
  observables::BifurcationRange range{BifurcationsOf::period_doubling, "force.cosine", 25, 25.05, 1.2, 1.7,
                                      observables::Branches::all};
  range.limits.doublings = 1;
  const auto found = curves(s, range);
  // By shooting at 25 N, with a multiplier of -1.00000000: of the period of the force, and of two.
  const double once[] = {1.23527688, 1.65078397}, twice[] = {1.24508308, 1.37525475};
  for (const auto& [period, expected] : {std::pair{1, once}, std::pair{2, twice}})
    for (const double w : {expected[0], expected[1]})
      CHECK(std::count_if(found.begin(), found.end(), [&](const ResponseBranch& curve) {
              return curve.period == period && std::abs(curve.points.front().omega - w) < 1e-6;
            }) == 1);
  CHECK(found.size() == 4);
  for (const ResponseBranch& curve : found) {
    CHECK(curve.status == observables::Status::complete);
    check_multipliers(curve, 1e-6);
  }
  REQUIRE(found.front().untraced.size() == 1);
  CHECK(found.front().untraced[0].starts_with(
      "at force.cosine = 25, the branch that leaves at the period doubling at 1.2450"));
  CHECK(found.front().untraced[0].ends_with(": the period was doubled 1 time already (doublings)"));

  range.branches = observables::Branches::one;
  const auto none = curves(s, range);
  REQUIRE(none.size() == 1);
  CHECK(none[0].stop.message.ends_with("and no other (\"branches\": \"all\")"));
  REQUIRE(none[0].untraced.size() == 1);
  CHECK(none[0].untraced[0].starts_with(
      "at force.cosine = 25, the branch that leaves at the break of symmetry at 1.2026"));
  CHECK(none[0].untraced[0].ends_with(": only one branch was looked at (\"branches\" is \"one\")"));
  REQUIRE(none[0].found_none);
  CHECK(none[0].found_none->amplitude > 4.5);
  CHECK(none[0].found_none->estimate > 0);
  range.of = BifurcationsOf::symmetry_breaking;
  const auto breaks = curves(s, range);
  REQUIRE(breaks.size() == 1);
  CHECK(breaks[0].status == observables::Status::complete);
  CHECK(breaks[0].untraced == none[0].untraced);
  const auto no_pair = curves(double_well(9), {BifurcationsOf::neimark_sacker, "f.cosine", 0.01, 0.02, 0.9,
                                               1.1, observables::Branches::all});
  REQUIRE(no_pair.size() == 1);
  CHECK(no_pair[0].stop.message.find(": the branches from the ends of the window and those that leave them "
                                     "were looked at, for 9 values of f.cosine, up to ") !=
        std::string::npos);
  CHECK(no_pair[0].stop.message.ends_with(" of them; others were not searched for (\"searches\")"));
  observables::BifurcationRange searched{BifurcationsOf::neimark_sacker, "f.cosine", 0.01, 0.02, 0.9, 1.1,
                                         observables::Branches::all};
  searched.limits.searches = 2;
  CHECK(curves(double_well(9), searched)[0].stop.message.ends_with(
      " of them; others were searched for at 2 frequencies of each value"));
}

// The window has the lower break of symmetry at 27 N only: the branch is entered from there, and at 24 N from
// the upper one, in a motion that is the mirror image of the other.
TEST_CASE("mirror images double their period on the same curve", "[numbers]") {
  observables::BifurcationRange range{BifurcationsOf::period_doubling, "force.cosine", 24, 27, 1.2, 3,
                                      observables::Branches::all};
  range.limits.doublings = 0;
  const auto found = curves(hardening_duffing(), range);
  CHECK(found.size() == 2);
  for (const double at_27 : {1.26092747, 1.70241092})
    CHECK(std::count_if(found.begin(), found.end(), [&](const ResponseBranch& curve) {
            return std::abs(curve.points.back().omega - at_27) < 1e-6;
          }) == 1);
}

TEST_CASE("curves of bifurcations leave the window of frequencies, and stop for the user") {
  const observables::BifurcationRange range{BifurcationsOf::all, "f.cosine", 0.15, 0.4, 1.0, 1.3};
  const auto found = curves(double_well(20), range);
  REQUIRE(found.size() == 1);
  CHECK(found[0].status == observables::Status::complete);
  CHECK(found[0].stop.reason == observables::reasons::boundary);
  CHECK(found[0].stop.message.find("the period doubling leaves the window at 1") == 0);
  for (const auto& point : found[0].points) CHECK((point.omega > 1 - 1e-9 && point.omega < 1.3 + 1e-9));
  int calls = 0;
  const auto stopped = observables::bifurcation_curves(double_well(20), range,
                                                       controls::polled([&] { return ++calls < 400; }));
  REQUIRE_FALSE(stopped.empty());
  CHECK(stopped.back().status == observables::Status::stopped);
  CHECK(stopped.back().stop.reason == observables::reasons::user);
}
