#include "catch.hpp"

#include "lib/laws/every_law.hpp"
#include "lib/laws/iwan_laws.hpp"

#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/elements/hysteresis_loops.hpp>
#include <arcslip/elements/iwan_power_law.hpp>
#include <arcslip/elements/jenkins.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/responses_at.hpp>
#include <arcslip/observables/time_study.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace arcslip;
using Eigen::MatrixXd, Eigen::VectorXd;
using elements::Harmonics;
using std::numbers::pi;

namespace {

// A motion whose harmonics fall as n^-2, of largest coefficient `amplitude`.
VectorXd motion(const Harmonics& h, double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  VectorXd u(h.size());
  for (int i = 0; i < h.cosines(); ++i)
    u[i] = number(random) / std::max(1, h.cosine_order(i) * h.cosine_order(i));
  for (int j = 0; j < h.sines(); ++j)
    u[h.cosines() + j] = number(random) / (h.sine_order(j) * h.sine_order(j));
  return amplitude * u / u.cwiseAbs().maxCoeff();
}

struct At {
  VectorXd force;
  MatrixXd jacobian;
  std::vector<VectorXd> by_field;
  double stick_share;
};

At at(elements::Element& element, const VectorXd& u, const std::vector<double>& fields) {
  element.move_to(u, fields, true);
  At result{element.force(), element.jacobian(), {}, 0};
  for (std::size_t k = 0; k < fields.size(); ++k) {
    VectorXd dF(u.size());
    element.field_derivative(static_cast<int>(k), dF);
    result.by_field.push_back(dF);
  }
  elements::FrictionState state;
  REQUIRE(element.friction(state));
  result.stick_share = state.stick_share;
  return result;
}

// pi * sum n (a_n F_sin - b_n F_cos): the work of a period.
double work(const Harmonics& h, const VectorXd& u, const VectorXd& F) {
  double sum = 0;
  for (int j = 0; j < h.sines(); ++j) {
    const int n = h.sine_order(j), a = h.cosine_index(n), b = h.sine_index(n);
    sum += pi * n * (u[b] * F[a] - u[a] * F[b]);
  }
  return sum;
}

}  // namespace

TEST_CASE("the four-parameter backbone has Segalman's numbers") {
  // K_T = 2, F_S = 3, chi = -0.1, beta = 0.1
  const elements::PowerLaw law(-0.1, 0.1);
  CHECK(std::abs(law.largest() * 3 / 2 - 2.87614678899) < 1e-11);
  const double y = 1.0 * 2 / 3;
  const auto values = law.at(y);
  CHECK(std::abs(3 * (values.rest + y * values.slope) - 1.63021118830) < 1e-11);
  // R phi^chi over (0, d): R d^(chi+1)/(chi+1) is its stiffness.
  const double phi_max = law.largest() * 3 / 2, d = 0.01 * phi_max;
  CHECK(std::abs(law.between(0, 0.01).stiffness * 2 * 0.9 / std::pow(d, 0.9) - 0.63233886802) < 1e-11);
  const auto whole = law.between(0, 1), last = law.at_most();
  CHECK(std::abs(whole.stiffness + last.stiffness - 1) < 1e-15);
  CHECK(std::abs(whole.slip_force + last.slip_force - 1) < 1e-15);
  CHECK(law.at(law.largest()).rest == 1);
}

TEST_CASE("the dissipation in a cycle is that of the closed form, in microslip and beyond") {
  const Harmonics h{1, true};
  const auto law = iwan_laws::law(iwan_laws::four_parameter);
  const auto element = law->element(h, {});
  const auto dissipated = [&](double amplitude, double chi, double beta) {
    element->move_to(VectorXd{{amplitude, 0.0}}, std::vector<double>{2, 3, chi, beta}, false);
    return work(h, VectorXd{{amplitude, 0.0}}, element->force());
  };
  CHECK(std::abs(dissipated(1, -0.1, 0.1) - 0.45904818005) < 1e-11);
  for (const double chi : {-0.9, -0.5, -0.1, 0.0})
    for (const double beta : {0.0, 0.1, 3.0}) {
      const elements::PowerLaw shape(chi, beta);
      const double phi_max = shape.largest() * 1.5;
      const double R = 3 * (chi + 1) / (std::pow(phi_max, chi + 2) * (beta + (chi + 1) / (chi + 2)));
      for (const double A : {1e-6, 1e-3, 0.1, 0.5, 0.999}) {  // of phi_max; Segalman (2005), equation 25
        const double expected = 4 * R * std::pow(A * phi_max, chi + 3) / ((chi + 3) * (chi + 2));
        CAPTURE(chi, beta, A);
        CHECK(std::abs(dissipated(A * phi_max, chi, beta) / expected - 1) <
              1e-11 + 1e-14 / std::pow(A, chi + 1));
      }
      const double S = 3 / phi_max * beta / (beta + (chi + 1) / (chi + 2));
      for (const double A : {1.001, 2.0, 100.0, 1e6}) {
        const double x = A * phi_max;
        const double expected = 4 * R * std::pow(phi_max, chi + 2) * (x / (chi + 2) - phi_max / (chi + 3)) +
                                4 * S * phi_max * (x - phi_max);
        CHECK(std::abs(dissipated(x, chi, beta) / expected - 1) < 1e-11 + 1e-15 * A);
      }
    }
}

TEST_CASE("in microslip the dissipation grows as amplitude^(3 + chi)") {
  const Harmonics h{5, false};
  const auto law = iwan_laws::law(iwan_laws::four_parameter);
  const auto element = law->element(h, {});
  for (const double chi : {-0.7, -0.3, 0.0}) {
    double last = 0;
    for (const double size : {1e-3, 1e-2, 1e-1}) {
      const VectorXd u = motion(h, size, 4);
      element->move_to(u, std::vector<double>{2, 3, chi, 0.2}, false);
      const double now = work(h, u, element->force());
      if (last > 0) CHECK(std::abs(std::log10(now / last) - 3 - chi) < 1e-8);
      last = now;
    }
  }
}

TEST_CASE("with one harmonic the uniform distribution has its describing function") {
  // From f = K A (1 - A/(2 phi_max)) - K (A - x) + K (A - x)^2/(4 phi_max) on the way down: F_c = K A (1 -
  // A/(2 phi_max)), F_s = -2 K A^2/(3 pi phi_max).
  const Harmonics h{1, true};
  const auto law = iwan_laws::law(iwan_laws::uniform);
  const auto element = law->element(h, {});
  const double K = 2, phi_max = 3;
  for (const double A : {1e-9, 1e-3, 0.5, 1.7, 2.999}) {
    element->move_to(VectorXd{{A, 0.0}}, std::vector<double>{2, 3}, true);
    CHECK(std::abs(element->force()[0] / (K * A * (1 - A / (2 * phi_max))) - 1) < 1e-13);
    CHECK(std::abs(element->force()[1] * pi * A / (-2 * K * A * A * A / (3 * phi_max)) - 1) <
          1e-12 + 1e-14 / A);
  }
}

TEST_CASE("a table of one slider is a Jenkins element") {
  const auto law = iwan_laws::law(iwan_laws::table({{2, 0.5}}));
  for (const bool odd : {true, false})
    for (const int order : {1, 3, 7, 15})
      for (unsigned seed = 1; seed <= 10; ++seed)
        for (const double load : {0.0, 1e-6, 0.3, 1.0, 2.0, 5.0, 1e3}) {
          const Harmonics h{order, odd};
          const auto element = law->element(h, {}), jenkins = elements::jenkins().element(h, {});
          const VectorXd u = motion(h, 1, seed);
          const At ours = at(*element, u, {1.5, load}), theirs = at(*jenkins, u, {3, 0.5, load});
          // With the least load slip begins 1e-3 rad behind a reversal.
          const double digits = load == 1e-6 ? 1e-11 : 1e-12;
          CAPTURE(odd, order, seed, load);
          CHECK((ours.force - theirs.force).norm() < 1e-12);
          CHECK((ours.jacobian - theirs.jacobian).norm() < 1e-12 * order);
          CHECK((ours.by_field[0] - 2 * theirs.by_field[0]).norm() < digits);
          CHECK((ours.by_field[1] - theirs.by_field[2]).norm() < digits);
          CHECK(std::abs(ours.stick_share - theirs.stick_share) < digits);
        }
}

TEST_CASE("a table is the sum of its sliders, each as a Jenkins element") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0.05, 1);
  for (const bool odd : {true, false})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const Harmonics h{9, odd};
      std::vector<std::pair<double, double>> sliders;
      for (int j = 0; j < 50; ++j) sliders.emplace_back(number(random), 0.7 * number(random));
      const auto law = iwan_laws::law(iwan_laws::table(sliders));
      const auto element = law->element(h, {}), jenkins = elements::jenkins().element(h, {});
      const VectorXd u = motion(h, 1, seed);
      const At ours = at(*element, u, {1, 1});
      VectorXd F = VectorXd::Zero(u.size());
      MatrixXd J = MatrixXd::Zero(u.size(), u.size());
      double stiffness = 0, stuck = 0;
      for (const auto& [k, p] : sliders) {
        const At one = at(*jenkins, u, {k, 1, p});
        F += one.force;
        J += one.jacobian;
        stiffness += k;
        stuck += k * one.stick_share;
      }
      CAPTURE(odd, seed);
      CHECK((ours.force - F).norm() < 1e-12 * stiffness);
      CHECK((ours.jacobian - J).norm() < 1e-11 * stiffness);
      CHECK(std::abs(ours.stick_share - stuck / stiffness) < 1e-12);
    }
}

TEST_CASE("the direct sum of many Jenkins elements comes to the continuous distribution as n^-2") {
  const std::vector<double> fields{2, 3, -0.4, 0.3};
  const auto law = iwan_laws::law(iwan_laws::four_parameter);
  const elements::PowerLaw shape(fields[2], fields[3]);
  for (const bool odd : {true, false})
    for (const double amplitude : {0.3, 2.0, 8.0}) {
      const Harmonics h{5, odd};
      const VectorXd u = motion(h, amplitude, 7);
      const At exact = at(*law->element(h, {}), u, fields);
      double last = 0;
      for (const int count : {250, 1000, 4000}) {
        const auto jenkins = elements::jenkins().element(h, {});
        VectorXd F = VectorXd::Zero(u.size());
        MatrixXd J = MatrixXd::Zero(u.size(), u.size());
        const auto add = [&](const elements::PowerLaw::Share& share) {
          const At one = at(*jenkins, u, {2 * share.stiffness, 1, 3 * share.slip_force});
          F += one.force;
          J += one.jacobian;
        };
        for (int j = 0; j < count; ++j)
          add(shape.between(std::pow(static_cast<double>(j) / count, 2),
                            std::pow(static_cast<double>(j + 1) / count, 2)));
        add(shape.at_most());
        const double error = (F - exact.force).norm(), of_jacobian = (J - exact.jacobian).norm();
        CAPTURE(odd, amplitude, count, error, of_jacobian);
        if (last > 0) CHECK(error < 0.16 * last);
        CHECK(of_jacobian < 4.0 / count);  // of the one slider whose slip is about to begin
        last = error;
      }
      CHECK(last < 1e-6);
    }
}

TEST_CASE("the coefficients are those of double exponential integration of the force") {
  // x = (1 + tanh(pi/2 sinh t))/2 on each part of a branch, at whose ends the force has powers of the angle.

  for (const bool odd : {true, false})
    for (const int order : {1, 2, 5, 15, 31})
      for (const double chi : {-0.95, -0.5, -0.1, 0.0})
        for (const double amplitude : {1e-3, 1.0, 50.0})
          for (const unsigned seed : {1u, 2u, 3u}) {
            const std::vector<double> fields{2, 3, chi, seed == 1 ? 0 : 0.3};
            const auto law = iwan_laws::law(iwan_laws::four_parameter);
            const Harmonics h{order, odd};
            const VectorXd u = motion(h, amplitude, seed);
            const auto element = law->element(h, {});
            element->move_to(u, fields, false);
            elements::HysteresisLoops loops(h);
            loops.find(u);
            const double limit = elements::PowerLaw(chi, fields[3]).largest() * 1.5;
            VectorXd F = VectorXd::Zero(h.size()), phi(h.size());
            double largest = 0;
            const auto add = [&](double begin, double end) {
              std::vector<double> angles, weights;
              const double step = 0.02;
              for (int i = -180; i <= 180; ++i) {
                const double t = i * step, inner = pi / 2 * std::sinh(t),
                             share = 1 / (1 + std::exp(-2 * inner));
                angles.push_back(begin + (end - begin) * share);
                weights.push_back((end - begin) * step * pi / 4 * std::cosh(t) /
                                  std::pow(std::cosh(inner), 2));
              }
              const MatrixXd f = law->force_at(h, u, fields, angles);
              for (std::size_t i = 0; i < angles.size(); ++i) {
                elements::series_basis(h, angles[i], phi);
                F += (odd ? 2 : 1) / pi * weights[i] * f(static_cast<Eigen::Index>(i), 0) * phi;
                largest = std::max(largest, std::abs(f(static_cast<Eigen::Index>(i), 0)));
              }
            };
            for (const auto& part : loops.parts()) {
              const auto& anchor = loops.anchors()[static_cast<std::size_t>(part.anchor)];
              const double macroslip = anchor.x + 2 * anchor.way * limit;
              const bool within =
                  anchor.way * (macroslip - part.begin.x) > 0 && anchor.way * (part.end.x - macroslip) > 0;
              const double middle =
                  within ? loops.crossing(u, part.begin, part.end, macroslip) : part.end.theta;
              add(part.begin.theta, middle);
              if (within) add(middle, part.end.theta);
            }
            if (!odd) F[0] *= 0.5;
            CAPTURE(odd, order, chi, amplitude, seed);
            const double error = (F - element->force()).cwiseAbs().maxCoeff() / largest;

            CHECK(error < 1e-12);
          }
}

TEST_CASE("an iwan element keeps what every law promises, for all distributions and kinds of motion") {
  const std::vector<std::pair<std::string, std::vector<double>>> all{
      {iwan_laws::uniform, {2, 0.8}},
      {iwan_laws::four_parameter, {2, 0.8, -0.3, 0.4}},
      {iwan_laws::table({{0.7, 0.2}, {1.1, 0.4}, {0.3, 0.35}}), {1.2, 0.9}}};
  for (const auto& [text, fields] : all) {
    const auto law = iwan_laws::law(text);
    for (unsigned seed = 1; seed <= 20; ++seed)
      for (const bool odd : {false, true}) {
        CAPTURE(text, seed, odd);
        every_law::check_element(*law, fields, 1, odd, 1e-6, 2e-7, 1e-6, seed);
      }
    every_law::check_energy(*law, fields, 1, 1e-5, 5);
  }
}

TEST_CASE("force and Jacobian are finite and bounded at extremes of motion, stiffness and load") {
  const std::vector<std::pair<std::string, std::vector<std::vector<double>>>> all{
      {iwan_laws::uniform, {{2, 3}, {2, 0}, {1e-12, 1e12}, {1e12, 1e-12}, {1e12, 0}}},
      {iwan_laws::four_parameter,
       {{2, 3, -0.1, 0.1},
        {2, 3, -0.999999, 0},
        {2, 0, -0.5, 0.1},
        {1e12, 1e-6, -0.9, 1e9},
        {2, 3, 0, 1e-300}}},
      {iwan_laws::table({{1, 1}, {1e-6, 1e6}, {1e6, 1e-6}, {1, 1}, {2, 2}}),
       {{1, 1}, {1, 0}, {1e12, 1}, {1, 1e-12}}}};
  for (const auto& [text, settings] : all) {
    const auto law = iwan_laws::law(text);
    for (const auto& fields : settings)
      for (const bool odd : {true, false})
        for (const int order : {1, 3, 15}) {
          const Harmonics h{order, odd};
          const auto element = law->element(h, {});
          const elements::Traits traits = law->traits(fields, 0);
          for (const double amplitude : {0.0, 1e-300, 1e-30, 1e-6, 1.0, 1e6, 1e30, 1e100})
            for (unsigned seed = 1; seed <= 4; ++seed) {
              VectorXd u = motion(h, 1, seed);
              if (seed == 2 && !odd) u.tail(u.size() - 1) *= 1e-14;  // nearly constant
              if (seed == 3 && !odd) u.tail(u.size() - 1).setZero();
              if (seed == 4)  // the same reversals several times in a period
                for (int n = 1; n <= order; ++n)
                  if (h.has(n) && n % 3 != 0) u[h.cosine_index(n)] = u[h.sine_index(n)] = 0;
              u *= amplitude;
              CAPTURE(text, fields, odd, order, amplitude, seed);
              const At now = at(*element, u, fields);
              CHECK(now.force.allFinite());
              CHECK(now.jacobian.allFinite());
              for (const VectorXd& dF : now.by_field) CHECK(dF.allFinite());
              CHECK(now.force.cwiseAbs().maxCoeff() <=
                    1.3 * traits.limit + 1e-13 * traits.stiffness * amplitude);
              CHECK(now.jacobian.cwiseAbs().maxCoeff() <= (4 + order) * traits.stiffness);
              CHECK((now.stick_share >= 0 && now.stick_share <= 1));
            }
        }
  }
}

TEST_CASE(
    "the force does not change with the mean of the motion, nor with the instant at which a period begins") {
  for (const std::string& text : {iwan_laws::uniform, iwan_laws::four_parameter,
                                  iwan_laws::table({{0.7, 0.2}, {1.1, 0.4}, {0.3, 0.35}})}) {
    const auto law = iwan_laws::law(text);
    std::vector<double> fields{1.3, 0.8};
    if (text == iwan_laws::four_parameter) fields = {2, 0.8, -0.3, 0.4};
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const Harmonics h{7, false};
      const auto element = law->element(h, {});
      const VectorXd u = motion(h, 1, seed);
      element->move_to(u, fields, false);
      const VectorXd F = element->force();
      VectorXd moved = u;
      moved[0] += 0.7;
      element->move_to(moved, fields, false);
      CHECK((element->force() - F).norm() < 1e-12);
      const double turn = 0.3 * seed;
      const auto turned = [&](const VectorXd& x) {
        VectorXd y = x;
        for (int n = 1; n <= h.order; ++n) {
          const double c = std::cos(n * turn), s = std::sin(n * turn), a = x[h.cosine_index(n)],
                       b = x[h.sine_index(n)];
          y[h.cosine_index(n)] = c * a - s * b;
          y[h.sine_index(n)] = s * a + c * b;
        }
        return y;
      };
      element->move_to(turned(u), fields, false);
      CAPTURE(text, seed);
      CHECK((element->force() - turned(F)).norm() < 1e-12);
    }
  }
}

TEST_CASE("odd harmonics alone and all harmonics agree on an odd motion") {
  for (const std::string& text : {iwan_laws::uniform, iwan_laws::four_parameter,
                                  iwan_laws::table({{0.7, 0.2}, {1.1, 0.4}, {0.3, 0.35}})}) {
    const auto law = iwan_laws::law(text);
    std::vector<double> fields{1.3, 0.8};
    if (text == iwan_laws::four_parameter) fields = {2, 0.8, -0.3, 0.4};
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const Harmonics odd{9, true}, all{9, false};
      const VectorXd u = motion(odd, 1, seed);
      VectorXd v(all.size());
      elements::transfer(odd, u, all, v);
      const At one = at(*law->element(odd, {}), u, fields), other = at(*law->element(all, {}), v, fields);
      VectorXd F(all.size());
      elements::transfer(odd, one.force, all, F);
      CHECK((F - other.force).norm() < 1e-12);
      VectorXd J(all.size());
      const VectorXd direction = motion(odd, 1, seed + 100);
      elements::transfer(odd, direction, all, v);
      elements::transfer(odd, one.jacobian * direction, all, J);
      CHECK((J - other.jacobian * v).norm() < 1e-11);
      CHECK(std::abs(one.stick_share - other.stick_share) < 1e-12);
    }
  }
}

TEST_CASE("in harmonics a table comes to the exact march in time, in random structures") {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> number(0.1, 1);
  int compared = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<std::pair<double, double>> sliders;
    for (int j = 0; j < 1 + trial % 6; ++j) sliders.emplace_back(number(random), 0.3 * number(random));
    const char* places[] = {R"("at": "a")", R"("at": "b")", R"("between": ["a", "b"])"};
    const bool even = trial % 2 == 1;
    std::ostringstream text;
    text.precision(17);
    text
        << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
      "structure": {"dofs": ["a", "b"], "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b",
        "value": )"
        << number(random) << R"(}], "springs": [{"name": "ka", "at": "a", "value": 1},
        {"name": "kb", "between": ["a", "b"], "value": )"
        << 2 * number(random)
        << R"(}], "dampers": [{"name": "ca", "at": "a", "value": 0.1}, {"name": "cb", "at": "b", "value": 0.1}]},
      "elements": [{"name": "joint", )"
        << places[trial % 3] << ", " << iwan_laws::table(sliders)
        << R"(}], "excitation": [{"name": "f", "at": "a", "cosine": )" << number(random) << "}"
        << (even ? R"(, {"name": "g", "at": "b", "sine": 0.2, "harmonic": 2})" : "")
        << R"(], "response": {"at": "b"}, "harmonics": {"order": 101}})";
    const scene::Scene s = scenes::parse(text.str());
    const double frequency = 0.3 + number(random);
    const auto found = observables::point_responses(s, {.frequency = frequency});
    const auto motion = observables::motion_in_time(s, {.frequency = frequency});
    CAPTURE(trial, sliders, frequency, motion.stop.message);
    REQUIRE(found.size() == 1);
    REQUIRE(motion.status == observables::Status::complete);
    CHECK(motion.integrator == "event-driven");
    const auto& point = found[0].point;
    CHECK(std::abs(point.energy_friction - motion.energy.friction) < 1e-5 * point.energy_input);
    CHECK(std::abs(motion.energy.defect()) < 1e-9);
    // A slider that never slips keeps an offset of its own in time, and with it the mean.
    if (motion.energy.friction == 0 || even) continue;
    CHECK(std::abs(point.amplitude / motion.amplitude - 1) < 3e-6);
    CHECK(std::abs(point.elements[0].stick_percent - motion.elements[0].stick_percent) < 1e-2);
    ++compared;
  }
  CHECK(compared > 30);
}

TEST_CASE("in microslip a response comes to its limit as N^-4, and that of a table as N^-3") {
  for (const bool microslip : {true, false}) {
    const std::string joint = microslip ? R"("type": "iwan", "stiffness": 2, "slip_force": 4)"
                                        : iwan_laws::table({{1, 0.2}, {0.5, 0.3}, {0.5, 0.7}});
    const auto amplitude = [&](int order) {
      const auto found =
          observables::point_responses(iwan_laws::oscillator(joint, 1, order), {.frequency = 0.47});
      REQUIRE(found.size() == 1);
      return found[0].point.amplitude;
    };
    const double limit = amplitude(401);
    for (const int order : {7, 15, 31, 63, 127}) {
      CAPTURE(microslip, order);
      const double error = std::abs(amplitude(order) / limit - 1);
      CHECK(error < (microslip ? 1e-3 * std::pow(order, -4) : 0.1 * std::pow(order, -3)));
    }
  }
}

TEST_CASE("in time a continuous distribution is divided into sliders, with an error of sliders^-2") {
  const std::string continuous[] = {
      R"("type": "iwan", "stiffness": 2, "slip_force": 0.6)",
      R"("type": "iwan", "distribution": "four-parameter", "stiffness": 2, "slip_force": 0.6, "exponent": -0.5,
         "beta": 0.3)"};
  for (const std::string& joint : continuous)
    for (const double frequency : {0.9, 1.3}) {
      const auto found =
          observables::point_responses(iwan_laws::oscillator(joint, 0.4, 101), {.frequency = frequency});
      REQUIRE(found.size() == 1);
      const auto& point = found[0].point;
      for (const int sliders : {20, 60}) {
        const scene::Scene s =
            iwan_laws::oscillator(joint + R"(, "sliders": )" + std::to_string(sliders), 0.4);
        const auto motion = observables::motion_in_time(s, {.frequency = frequency});
        const auto newmark = observables::motion_in_time(
            s, {.frequency = frequency, .method = observables::TimeMethod::newmark_shooting, .steps = 1000});
        REQUIRE(motion.status == observables::Status::complete);
        REQUIRE(newmark.status == observables::Status::complete);
        CHECK(motion.integrator == "event-driven");
        CAPTURE(joint, frequency, sliders);
        CHECK(std::abs(motion.amplitude / point.amplitude - 1) < 0.8 / (sliders * sliders));
        CHECK(std::abs(motion.energy.friction / point.energy_friction - 1) < 2.5 / (sliders * sliders));
        CHECK(std::abs(newmark.amplitude / motion.amplitude - 1) < 2e-5);
        const double stick = point.elements[0].stick_percent;
        CHECK(std::abs(motion.elements[0].stick_percent - stick) < 100.0 / (sliders * sliders));
        CHECK(std::abs(newmark.elements[0].stick_percent - stick) < 100.0 / (sliders * sliders) + 0.06);
      }
    }
}

TEST_CASE("the memory of a force has that force") {
  for (const std::string& text : {iwan_laws::uniform, iwan_laws::four_parameter,
                                  iwan_laws::table({{0.7, 0.2}, {1.1, 0.4}, {0.3, 0.35}})}) {
    const auto law = iwan_laws::law(text);
    std::vector<double> fields{1.3, 0.8};
    if (text == iwan_laws::four_parameter) fields = {2, 0.8, -0.3, 0.4};
    const double limit = law->traits(fields, 0).limit;
    for (const double share : {-1.0, -0.7, -1e-6, 0.0, 1e-9, 0.3, 0.999, 1.0}) {
      const VectorXd q{{0.4}}, f{{share * limit}};
      VectorXd z(law->memory());
      law->memory_at(fields, q, f, z);
      elements::StepEnd at(1, law->memory());
      law->begin(fields, q, z, at);
      CHECK(std::abs(at.f[0] - f[0]) < 1e-14);
    }
  }
}

TEST_CASE("residuals with an iwan element have the Jacobian of their differences") {
  for (const std::string& joint :
       {iwan_laws::uniform, iwan_laws::four_parameter, iwan_laws::table({{1, 0.2}, {0.5, 0.3}, {0.5, 0.7}})})
    for (const double size : {0.05, 1.0, 20.0}) {
      const auto model = std::make_shared<const model::Model>(model::build(iwan_laws::oscillator(
          joint, 0.4, 5, 0.05, R"(, {"name": "g", "at": "x", "sine": 0.3, "harmonic": 2})")));
      const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
      const VectorXd u = motion({5, false}, size, 3);
      CAPTURE(joint, size);
      CHECK(continuation::check_jacobian(problem, u, hbm::parameters_at(problem, 0.9)).message == "");
    }
}

TEST_CASE("every study works with an iwan element, and is complete") {
  const auto run = [](const std::string& joint, const std::string& slip) {
    std::string text = scene::write(iwan_laws::oscillator(joint, 0.4, 9));
    const std::string old = text.substr(text.find("\"studies\""));
    text.replace(text.find(old), old.size(), R"("studies": [
      {"kind": "frf", "from": 0.4, "to": 2.5},
      {"kind": "trace", "over": ")" + slip + R"(", "from": 0.1, "to": 2, "frequency": 1.2},
      {"kind": "peaks", "over": ")" + slip + R"(", "from": 0.1, "to": 2, "frequency": [0.8, 2.2]},
      {"kind": "point", "frequency": 1.2}, {"kind": "time", "frequency": 1.2},
      {"kind": "optimum", "over": [")" + slip + R"("], "bounds": [[0.1, 2]], "frequency": [0.8, 2.2]}]})");
    const scene::Scene s = scenes::parse(text);
    std::istringstream again(scene::write(s));
    CHECK(scene::read(again, test_catalogue::whole()) == s);
    std::ostringstream out;
    results::write_json(out, studies::run(s));
    const auto json = nlohmann::json::parse(out.str());
    for (const char* kind : {"branches", "responses", "motions", "optima"})
      for (const auto& each : json.at(kind)) {
        CAPTURE(joint, kind, each.value("status", ""));
        CHECK(each["status"] == "complete");
      }
  };
  run(R"("type": "iwan", "stiffness": 2, "slip_force": 0.6)", "joint.slip_force");
  run(iwan_laws::four_parameter, "joint.slip_force");
  run(iwan_laws::table({{1, 0.2}, {0.5, 0.3}, {0.5, 0.7}}), "joint.slip_factor");
}

TEST_CASE("faults of the options are told, and fields are those of the distribution") {
  const auto fault = [](const std::string& element) {
    try {
      iwan_laws::oscillator(element);
    } catch (const scene::SceneError& error) {
      return error.faults()[0].pointer + ": " + error.faults()[0].message;
    }
    return std::string("none");
  };
  const std::string start = R"("type": "iwan", "distribution": )";
  CHECK(fault(start + R"("weibull", "stiffness": 1, "slip_force": 1)") ==
        "/elements/0/distribution: found \"weibull\", must be one of \"uniform\", \"four-parameter\", "
        "\"table\"");
  CHECK(fault(start + R"("table")") ==
        "/elements/0/table: found no key \"table\", which is required: must be a list of 1 to 10000 pairs "
        "[stiffness, slip limit], each above 0");
  CHECK(fault(start + R"("table", "table": [])") ==
        "/elements/0/table: found 0 sliders, must be a list of 1 to 10000 pairs [stiffness, slip limit], "
        "each above 0");
  CHECK(fault(start + R"("table", "table": [[1, 2], [3]])") ==
        "/elements/0/table/1: found 1 numbers, must be a pair [stiffness, slip limit]");
  CHECK(fault(start + R"("table", "table": [[1, 0]])") ==
        "/elements/0/table/0/1: found 0, must be above 0 N");
  CHECK(fault(start + R"("uniform", "stiffness": 1, "slip_force": 1, "table": [[1, 1]])") ==
        "/elements/0/table: found a table beside another \"distribution\" than \"table\"");
  CHECK(fault(start + R"("four-parameter", "stiffness": 1, "slip_force": 1, "exponent": -1, "beta": 0)") ==
        "/elements/0/exponent: found -1, must be above -1 and at most 0");
  CHECK(fault(start + R"("uniform", "stiffness": 1, "slip_force": 1, "beta": 0)").substr(0, 16) ==
        "/elements/0/beta");
  CHECK(fault(start + R"("four-parameter", "stiffness": 1, "slip_force": 1, "beta": 0)").substr(0, 20) ==
        "/elements/0/exponent");
}

TEST_CASE(
    "a corner lies where the piece changes, and its equations have the derivatives of their differences") {
  const std::vector<std::pair<std::string, std::vector<double>>> all{
      {iwan_laws::uniform, {2, 0.8}},
      {iwan_laws::four_parameter, {2, 0.8, -0.3, 0.4}},
      {iwan_laws::table({{0.7, 0.2}, {1.1, 0.4}, {0.3, 0.35}}), {1.2, 0.9}}};
  int found = 0;
  for (const auto& [text, fields] : all)
    for (const bool odd : {false, true})
      for (unsigned seed = 1; seed <= 30; ++seed) {
        const auto law = iwan_laws::law(text);
        const Harmonics h{4, odd};
        const auto element = law->element(h, {});
        const auto corners = law->corners(h);
        // Along a line of motions, up to the first change of the piece.
        const VectorXd from = motion(h, 1, seed), along = motion(h, 1, seed + 500);
        const auto piece = [&](double s) {
          element->move_to(from + s * along, fields, false);
          return element->piece();
        };
        double low = 0, high = 0;
        while (high < 2 && piece(high) == piece(0)) high += 0.02;
        if (high >= 2) continue;
        for (int k = 0; k < 80; ++k) {
          const double middle = 0.5 * (low + high);
          (piece(middle) == piece(0) ? low : high) = middle;
        }
        const VectorXd w = from + 0.5 * (low + high) * along;
        element->move_to(from + (low - 1e-7) * along, fields, true);
        const MatrixXd before = element->jacobian();
        element->move_to(from + (high + 1e-7) * along, fields, true);
        const double jump = (element->jacobian() - before).norm();
        const auto near = corners->near(w, fields, 1e-9);
        CAPTURE(text, odd, seed, jump, near.size());
        if (jump < 1e-2) continue;  // the birth of a loop
        CHECK(near.size() == 1);
        for (elements::Corner corner : near) {
          ++found;
          elements::Corners::Equations at(h.size(), 2, static_cast<int>(fields.size())), other = at;
          corners->equations(corner, w, fields, at);
          CHECK(std::abs(at.values[0]) <= 1e-9 * corners->size(corner, w, fields));
          CHECK(at.values.tail(2).norm() < 1e-7);
          const double step = 1e-6;
          const auto values = [&](const VectorXd& u, const std::vector<double>& f,
                                  const std::vector<double>& angles) {
            elements::Corner there = corner;
            there.angles = angles;
            corners->equations(there, u, f, other);
            return VectorXd(other.values);
          };
          for (Eigen::Index i = 0; i < h.size(); ++i) {
            const VectorXd d = step * VectorXd::Unit(h.size(), i);
            const VectorXd slope =
                (values(w + d, fields, corner.angles) - values(w - d, fields, corner.angles)) / (2 * step);
            CHECK((slope - at.by_motion.col(i)).norm() < 1e-8);
          }
          for (std::size_t k = 0; k < fields.size(); ++k) {
            auto more = fields, less = fields;
            more[k] += step, less[k] -= step;
            const VectorXd slope =
                (values(w, more, corner.angles) - values(w, less, corner.angles)) / (2 * step);
            CHECK((slope - at.by_field.col(static_cast<Eigen::Index>(k))).norm() < 1e-8);
          }
          for (std::size_t k = 0; k < 2; ++k) {
            auto more = corner.angles, less = corner.angles;
            more[k] += step, less[k] -= step;
            const VectorXd slope = (values(w, fields, more) - values(w, fields, less)) / (2 * step);
            CHECK((slope - at.by_angle.col(static_cast<Eigen::Index>(k))).norm() < 1e-7);
          }
        }
      }
  CHECK(found > 40);
}

TEST_CASE("at its peaks the example of a bolted joint dissipates as in closed form, with slope 3 + chi") {
  const scene::Scene s = scenes::example("microslip_joint");
  const auto branches = scenes::frequency_responses(s, s.studies.front().for_each);
  REQUIRE(branches.size() == 8);
  double amplitude = 0, energy = 0, slope = 0;
  int in_microslip = 0;
  for (const auto& branch : branches) {
    CAPTURE(branch.stop.message);
    REQUIRE(branch.status == observables::Status::complete);
    REQUIRE(branch.events.size() == 1);
    const auto& peak = branch.events[0].point;
    REQUIRE(peak.elements.size() == 1);
    const double dissipated = peak.elements[0].energy;
    CAPTURE(peak.amplitude, dissipated);
    if (energy > 0) slope = std::log(dissipated / energy) / std::log(peak.amplitude / amplitude);
    if (peak.amplitude < 2.87614678899) {  // phi_max of Kt = 2, Fs = 3, chi = -0.1, beta = 0.1
      ++in_microslip;
      CHECK(std::abs(dissipated / (0.45904818005 * std::pow(peak.amplitude, 2.9)) - 1) < 1e-10);
      if (energy > 0) CHECK(std::abs(slope - 2.9) < 1e-9);
    }
    amplitude = peak.amplitude;
    energy = dissipated;
  }
  CHECK(in_microslip == 7);
  CHECK(slope < 2);  // from the last in microslip to the one in macroslip
}
