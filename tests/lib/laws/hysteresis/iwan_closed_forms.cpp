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

namespace {

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
      const VectorXd u = every_law::falling_motion(h, size, 4);
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
          const VectorXd u = every_law::falling_motion(h, 1, seed);
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
      const VectorXd u = every_law::falling_motion(h, 1, seed);
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
      const VectorXd u = every_law::falling_motion(h, amplitude, 7);
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
