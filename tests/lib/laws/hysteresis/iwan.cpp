#include "catch.hpp"

#include "lib/laws/every_law.hpp"
#include "lib/laws/hysteresis/iwan_laws.hpp"

#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/laws/hysteresis/hysteresis_loops.hpp>
#include <arcslip/laws/hysteresis/iwan_power_law.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace arcslip;
using Eigen::MatrixXd, Eigen::VectorXd;
using elements::Harmonics;
using iwan_laws::At, iwan_laws::at;
using std::numbers::pi;

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
            const VectorXd u = every_law::falling_motion(h, amplitude, seed);
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
              VectorXd u = every_law::falling_motion(h, 1, seed);
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
      const VectorXd u = every_law::falling_motion(h, 1, seed);
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
      const VectorXd u = every_law::falling_motion(odd, 1, seed);
      VectorXd v(all.size());
      elements::transfer(odd, u, all, v);
      const At one = at(*law->element(odd, {}), u, fields), other = at(*law->element(all, {}), v, fields);
      VectorXd F(all.size());
      elements::transfer(odd, one.force, all, F);
      CHECK((F - other.force).norm() < 1e-12);
      VectorXd J(all.size());
      const VectorXd direction = every_law::falling_motion(odd, 1, seed + 100);
      elements::transfer(odd, direction, all, v);
      elements::transfer(odd, one.jacobian * direction, all, J);
      CHECK((J - other.jacobian * v).norm() < 1e-11);
      CHECK(std::abs(one.stick_share - other.stick_share) < 1e-12);
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
      law->in_time(fields)->memory_at(q, f, z);
      elements::StepEnd at(1, law->memory());
      law->in_time(fields)->begin(q, z, at);
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
      const VectorXd u = every_law::falling_motion({5, false}, size, 3);
      CAPTURE(joint, size);
      CHECK(continuation::check_jacobian(problem, u, hbm::parameters_at(problem, 0.9)).message == "");
    }
}

TEST_CASE("faults of the options are reported, and fields are those of the distribution") {
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
        "/elements/0/table: found a table next to another \"distribution\" than \"table\"");
  CHECK(fault(start + R"("four-parameter", "stiffness": 1, "slip_force": 1, "exponent": -1, "beta": 0)") ==
        "/elements/0/exponent: found -1, must be above -1 and at most 0");
  CHECK(fault(start + R"("uniform", "stiffness": 1, "slip_force": 1, "beta": 0)").substr(0, 16) ==
        "/elements/0/beta");
  CHECK(fault(start + R"("four-parameter", "stiffness": 1, "slip_force": 1, "beta": 0)").substr(0, 20) ==
        "/elements/0/exponent");
}
