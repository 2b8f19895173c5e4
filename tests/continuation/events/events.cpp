#include "catch.hpp"

#include "continuation/problems.hpp"

#include <memory>

using namespace problems;

namespace {

constexpr double stiffness = 0.1, force = 0.18;

// Duffing oscillator with one harmonic a cos + b sin, m = k = 1; parameter w.
std::shared_ptr<const Problem> damped_duffing(double damping, double width) {
  return from_functions(
      2, {parameter("w", 0.5, width)},
      [=](In u, In p, Out F) {
        const double k = 1 - p[0] * p[0] + 0.75 * stiffness * u.squaredNorm(), c = damping * p[0];
        F[0] = k * u[0] + c * u[1] - force;
        F[1] = k * u[1] - c * u[0];
      },
      [=](In u, In p, Eigen::Ref<Eigen::MatrixXd> J) {
        const double g = 0.75 * stiffness, k = 1 - p[0] * p[0] + g * u.squaredNorm(), c = damping * p[0];
        J << k + 2 * g * u[0] * u[0], 2 * g * u[0] * u[1] + c, 2 * g * u[0] * u[1] - c,
            k + 2 * g * u[1] * u[1];
      },
      [=](In u, In p, int, Out dF) {
        dF[0] = -2 * p[0] * u[0] + damping * u[1];
        dF[1] = -2 * p[0] * u[1] - damping * u[0];
      },
      Vector::Constant(2, 0.25));
}

Monitor amplitude_peak() {
  return {"peak", [](const Accepted& now) { return now.u.dot(now.tangent.head(2)) / now.u.norm(); },
          Crossing::falling, [](const Accepted& now) { return now.u.norm(); }};
}

}  // namespace

TEST_CASE("a Duffing oscillator with damping down to 1e-6 has one peak and two folds, all of them smooth") {
  for (double damping : {1e-2, 1e-4, 1e-5, 1e-6})
    for (double upper : {6e2, 8e2, 1e3, 2e3, 3e3, 5e3, 7e3, 1e4}) {
      Options options = window(0.5, upper);
      options.step.largest_parameter = (upper - 0.5) / 150;
      options.step.relative_parameter = 0.05;
      const Branch branch =
          trace(damped_duffing(damping, upper - 0.5), {Vector{{0.24, 0.0}}, Vector{{0.5}}, 0, 1}, options,
                {amplitude_peak(), fold_monitor()});
      CAPTURE(damping, upper, branch.stop.message, branch.points.size());
      CHECK(branch.stop.reason == StopReason::boundary);
      const auto peaks = events_named(branch, "peak"), folds = events_named(branch, "fold");
      REQUIRE(peaks.size() == 1);
      REQUIRE(folds.size() == 2);
      for (const Event& event : branch.events) CHECK_FALSE(event.nonsmooth);
      // f^2 = z c^2 (1 - c^2/4 + g z), z = A^2, g = 3/4 stiffness, at w^2 = 1 + g z - c^2/2.
      const double g = 0.75 * stiffness, c2 = damping * damping, q = 1 - c2 / 4;
      const double z = 2 * force * force / c2 / (q + std::sqrt(q * q + 4 * g * force * force / c2));
      const double w2 = 1 + g * z - c2 / 2, amplitude = std::sqrt(z);
      // Rounding of k - w^2 + g z, relative to the force that it is balanced with.
      const double rounding = 2.2e-16 * w2 * amplitude / force;
      CHECK(std::abs(peaks[0].point.u.norm() / amplitude - 1) < 4 * rounding + 1e-12);
      CHECK(std::abs(peaks[0].point.parameter / std::sqrt(w2) - 1) < 4 * rounding + 1e-12);
      // Without damping, w^2 = 1 + g A^2 + f/A, whose least value is the lower fold; damping adds c^2.
      const double lower = std::cbrt(force / (2 * g));
      const double fold = std::sqrt(1 + g * lower * lower + force / lower);
      CHECK(std::abs(folds[1].point.parameter / fold - 1) < 10 * c2 + 1e-12);
    }
}

TEST_CASE(
    "the folds of p - p0 + lambda x - x^3 are found at mu = p0 +- 2 (lambda/3)^(3/2), close as they are") {
  for (double lambda : {1.0, 1e-2, 1e-4, 1e-6})
    for (double p0 : {0.0, 1.0}) {
      const auto problem = from_functions(1, {parameter("mu", p0)}, [=](In u, In p, Out F) {
        F[0] = (p[0] - p0) + lambda * u[0] - std::pow(u[0], 3);
      });
      const double fold = 2 * std::pow(lambda / 3, 1.5), width = 20 * fold;
      const double u = -std::cbrt(width);
      const Branch branch = trace(problem, {Vector{{u}}, Vector{{p0 - width}}, 0, 1},
                                  window(p0 - width, p0 + width), {fold_monitor()});
      CAPTURE(lambda, p0, branch.stop.message, branch.points.size());
      CHECK(branch.stop.reason == StopReason::boundary);
      REQUIRE(branch.events.size() == 2);
      CHECK(std::abs(branch.events[0].point.parameter - (p0 + fold)) < 1e-15 + 1e-12 * fold);
      CHECK(std::abs(branch.events[1].point.parameter - (p0 - fold)) < 1e-15 + 1e-12 * fold);
    }
}

TEST_CASE("the peak of q = 1 - (p - p0)^2 is one event, however its slope errs below the rounding of q") {
  const double p0 = 0.123456;
  const auto line = from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  for (double half : {1e-1, 1e-4, 1e-6, 3e-7, 1e-7})
    for (double error : {0.0, 1e-16, 1e-15, 1e-14}) {
      const auto q = [=](const Accepted& now) { return 1 - (now.parameter - p0) * (now.parameter - p0); };
      const Monitor peak{"peak",
                         [=](const Accepted& now) {
                           const double slope = -2 * (now.parameter - p0) +
                                                error / half * std::sin(1e3 * now.parameter / half);
                           return slope * now.tangent[1];
                         },
                         Crossing::falling, q};
      const Branch branch = trace(line, {Vector{{p0 - 0.9 * half}}, Vector{{p0 - 0.9 * half}}, 0, 1},
                                  window(p0 - 0.9 * half, p0 + half), {peak});
      CAPTURE(half, error, branch.points.size());
      CHECK(branch.stop.reason == StopReason::boundary);
      REQUIRE(branch.events.size() == 1);
      CHECK(std::abs(branch.events[0].point.parameter - p0) < 5e-8);
    }
}

TEST_CASE("a slope that only errs makes no events") {
  const auto line = from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  const Monitor noise{"noise", [](const Accepted& now) { return 1e-12 * std::sin(1e17 * now.parameter); },
                      Crossing::any, [](const Accepted&) { return 1.0; }};
  const Branch branch = trace(line, {Vector{{1.0}}, Vector{{1.0}}, 0, 1}, window(1, 1.001), {noise});
  CHECK(branch.stop.reason == StopReason::boundary);
  CHECK(branch.events.empty());
}

TEST_CASE(
    "a maximum and a minimum of q = 1.5 w tanh((p - c)/w) - p are not missed where w is a twelfth of a "
    "step") {
  const auto line = from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  constexpr double step = 0.01;
  for (double w : {step / 4, step / 6, step / 8})
    for (int k = 0; k < 13; ++k) {
      const double c = 0.5 + step * k / 13;
      const auto slope = [=](const Accepted& now) {
        const double sech = 1 / std::cosh((now.parameter - c) / w);
        return (1.5 * sech * sech - 1) * now.tangent[1];
      };
      const auto q = [=](const Accepted& now) {
        return 1.5 * w * std::tanh((now.parameter - c) / w) - now.parameter;
      };
      Options options = window(0, 1);
      options.step.largest_parameter = step;
      const Branch branch =
          trace(line, {Vector{{0.0}}, Vector{{0.0}}, 0, 1}, options,
                {{"maximum", slope, Crossing::falling, q}, {"minimum", slope, Crossing::rising, q}});
      CAPTURE(w, k, branch.points.size());
      REQUIRE(branch.events.size() == 2);
      const double off = w * std::acosh(std::sqrt(1.5));
      CHECK(branch.events[0].monitor == "minimum");
      CHECK(std::abs(branch.events[0].point.parameter - (c - off)) < 1e-10);
      CHECK(std::abs(branch.events[1].point.parameter - (c + off)) < 1e-10);
    }
}

TEST_CASE("a place of an event that its monitor refines to no place at all is not taken") {
  const auto line = from_functions(1, {{"p", "", 0}}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  for (const Vector& bad : {Vector(), Vector{{0.5}}, Vector{{0.5, std::nan("")}}, Vector{{0.25, 0.25}}}) {
    Monitor half{.name = "half", .value = [](const Accepted& now) { return now.u[0] - 0.5; }};
    half.refine = [&](const Accepted&) { return std::optional(RefinedEvent{bad, {}}); };
    const Branch branch =
        trace(line, {.u = Vector{{0.0}}, .p = Vector{{0.0}}}, {.lower = 0, .upper = 1}, {half});
    REQUIRE(branch.events.size() == 1);
    const bool is_place = bad.size() == 2 && bad.allFinite();
    CHECK(std::abs(branch.events[0].point.parameter - (is_place ? 0.25 : 0.5)) < 1e-12);
  }
}
