// Further solutions by deflation, as many as are known to exist, and branches that lie apart.

#include <arcslip/continuation/diagrams/deflation.hpp>
#include <arcslip/continuation/linear/linear_solvers.hpp>

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <numbers>
#include <stdexcept>

using namespace problems;

namespace {

std::shared_ptr<const Problem> polynomial(std::vector<double> roots, double scale = 1) {
  return from_functions({.size = 1,
                         .parameters = {parameter("p", 0)},
                         .residual =
                             [=](In u, In, Out F) {
                               F[0] = 1;
                               for (double root : roots) F[0] *= u[0] - root;
                             },
                         .jacobian =
                             [=](In u, In, Eigen::Ref<Matrix> J) {
                               J(0, 0) = 0;
                               for (std::size_t i = 0; i < roots.size(); ++i) {
                                 double product = 1;
                                 for (std::size_t k = 0; k < roots.size(); ++k)
                                   if (k != i) product *= u[0] - roots[k];
                                 J(0, 0) += product;
                               }
                             },
                         .scales = Vector{{scale}}});
}

std::vector<double> sorted(const std::vector<Vector>& found) {
  std::vector<double> values;
  for (const Vector& u : found) values.push_back(u[0]);
  std::sort(values.begin(), values.end());
  return values;
}

std::shared_ptr<const Problem> two_equations(ResidualFunction F, JacobianFunction J) {
  return from_functions(2, {parameter("p", 0)}, std::move(F), std::move(J));
}

void check_set(const std::vector<Vector>& found, const std::vector<Vector>& known, double tolerance) {
  CHECK(found.size() == known.size());
  for (const Vector& u : known)
    CHECK(
        std::any_of(found.begin(), found.end(), [&](const Vector& v) { return (u - v).norm() < tolerance; }));
}

// A solver of the user's.
class ByInverse final : public PlainSolver {
 public:
  const char* name() const override { return "by inverse"; }
  bool prepare(const Jacobian& J) override {
    inverse_ = Matrix(std::get<SparseMatrix>(J)).inverse();
    return inverse_.allFinite();
  }
  bool solve(In b, Out x) const override {
    x = inverse_ * b;
    return true;
  }

 private:
  Matrix inverse_;
};

}  // namespace

TEST_CASE("every root of a polynomial is found from one guess") {
  std::vector<double> chebyshev;
  for (int k = 8; k >= 1; --k) chebyshev.push_back(std::cos((2 * k - 1) * std::numbers::pi / 16));
  for (const auto& roots :
       {std::vector<double>{1, 2, 3, 4, 5}, std::vector<double>{-3, -1, 0.5, 10}, chebyshev})
    for (double guess : {0.3, -2.0, 7.0}) {
      const auto found = sorted(deflate(*polynomial(roots), Vector{{0.0}}, {}, {Vector{{guess}}}));
      CAPTURE(guess, roots.size());
      REQUIRE(found.size() == roots.size());
      for (std::size_t i = 0; i < roots.size(); ++i) CHECK(std::abs(found[i] - roots[i]) < 1e-9);
    }
}

TEST_CASE("distances are measured in the scales of the problem: roots at 100, 0 and -100") {
  const auto problem = polynomial({-100, 0, 100}, 100);
  const auto found = sorted(deflate(*problem, Vector{{0.0}}, {}, {Vector{{30.0}}}));
  REQUIRE(found.size() == 3);
  for (int i = 0; i < 3; ++i) CHECK(std::abs(found[static_cast<std::size_t>(i)] - 100 * (i - 1)) < 1e-7);
}

TEST_CASE("from a known solution itself the others are found, on both sides of it") {
  const auto found =
      sorted(deflate(*polynomial({-1, 0, 1}), Vector{{0.0}}, {Vector{{0.0}}}, {Vector{{0.0}}}));
  REQUIRE(found.size() == 2);
  CHECK(std::abs(found[0] + 1) < 1e-12);
  CHECK(std::abs(found[1] - 1) < 1e-12);
}

TEST_CASE(
    "the first deflated step for u^2 - 1 from 3, with the root 1 known, is Newton's for F / (u - 1)^2 + F") {
  // F = 8, F' = 6, s = -4/3; d = 2, h = -2 / (d (1 + d^2)) = -1/5: s~ = s / (1 - 4/15) = -20/11.
  std::vector<double> seen;
  const auto problem = from_functions(
      1, {parameter("p", 0)},
      [&](In u, In, Out F) {
        seen.push_back(u[0]);
        F[0] = u[0] * u[0] - 1;
      },
      [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = 2 * u[0]; });
  CHECK(deflate(*problem, Vector{{0.0}}, {Vector{{1.0}}}, {Vector{{3.0}}}, {.iterations = 1}).empty());
  REQUIRE(seen.size() >= 2);
  CHECK(seen[0] == 3);
  CHECK(std::abs(seen[1] - (3 - 20.0 / 11)) < 1e-14);
}

TEST_CASE("Himmelblau's system has four solutions, and his function nine stationary points") {
  const auto system = two_equations(
      [](In u, In, Out F) {
        F[0] = u[0] * u[0] + u[1] - 11;
        F[1] = u[0] + u[1] * u[1] - 7;
      },
      [](In u, In, Eigen::Ref<Matrix> J) { J << 2 * u[0], 1, 1, 2 * u[1]; });
  // Himmelblau, Applied Nonlinear Programming, 1972
  const std::vector<Vector> minima{Vector{{3.0, 2.0}}, Vector{{-2.805118, 3.131312}},
                                   Vector{{-3.779310, -3.283186}}, Vector{{3.584428, -1.848126}}};
  check_set(deflate(*system, Vector{{0.0}}, {}, {Vector{{1.0, 1.0}}}), minima, 1e-6);
  const auto gradient = two_equations(
      [](In u, In, Out F) {
        const double a = u[0] * u[0] + u[1] - 11, b = u[0] + u[1] * u[1] - 7;
        F[0] = 4 * a * u[0] + 2 * b;
        F[1] = 2 * a + 4 * b * u[1];
      },
      [](In u, In, Eigen::Ref<Matrix> J) {
        const double a = u[0] * u[0] + u[1] - 11, b = u[0] + u[1] * u[1] - 7;
        J << 4 * a + 8 * u[0] * u[0] + 2, 4 * u[0] + 4 * u[1], 4 * u[0] + 4 * u[1],
            2 + 8 * u[1] * u[1] + 4 * b;
      });
  std::vector<Vector> all = minima;
  for (const Vector& other :
       {Vector{{-0.270845, -0.923039}}, Vector{{-0.127961, -1.953715}}, Vector{{0.086678, 2.884255}},
        Vector{{3.385154, 0.073852}}, Vector{{-3.073026, -0.081353}}})
    all.push_back(other);
  check_set(deflate(*gradient, Vector{{0.0}}, {}, {Vector{{1.0, 1.0}}, Vector{{-1.0, -1.0}}}), all, 1e-5);
}

TEST_CASE(
    "the rod has 2 k + 1 shapes between its k-th and next buckling load, by sparse and by users' solvers") {
  const int n = 40;
  for (bool own : {false, true})
    for (int k : {0, 1, 2}) {
      const double load = std::pow((k + 0.5) * std::numbers::pi, 2);
      DeflationOptions options;
      if (own) options.linear_solver = [] { return block_elimination(std::make_unique<ByInverse>()); };
      std::vector<Vector> guesses{Vector::Zero(n)};
      for (int m : {1, 2}) {
        guesses.emplace_back(n);
        for (int i = 0; i < n; ++i)
          guesses.back()[i] = std::sin(m * std::numbers::pi * (i + 1.0) / (n + 1.0));
      }
      const auto found =
          deflate(*from_functions(rod(n)), Vector{{load}}, {Vector::Zero(n)}, guesses, options);
      CAPTURE(own, k);
      int small = 0;
      for (const Vector& u : found) {
        if (u.cwiseAbs().maxCoeff() > std::numbers::pi) continue;
        ++small;
        CHECK(
            std::any_of(found.begin(), found.end(), [&](const Vector& v) { return (u + v).norm() < 1e-6; }));
      }
      CHECK(small == 2 * k);
    }
}

TEST_CASE("where there is nothing else, nothing is found") {
  const Vector p{{0.0}};
  const auto none = from_functions(1, {parameter("p", 0)}, [](In u, In, Out F) { F[0] = u[0] * u[0] + 1; });
  CHECK(deflate(*none, p, {}, {Vector{{0.7}}, Vector{{-3.0}}}).empty());
  CHECK(deflate(*polynomial({-1, 1}), p, {Vector{{-1.0}}, Vector{{1.0}}},
                {Vector{{0.3}}, Vector{{1.0}}, Vector{{-40.0}}})
            .empty());
  CHECK(deflate(*polynomial({2, 2}), p, {Vector{{2.0}}}, {Vector{{2.0}}, Vector{{3.0}}}).empty());
  // Of a triple root a simple one is left: it is recognised.
  CHECK(deflate(*polynomial({2, 2, 2}), p, {Vector{{2.0}}}, {Vector{{2.0}}, Vector{{3.0}}}).empty());
  CHECK(deflate(*polynomial({-1, 1}), p, {}, {}).empty());
}

TEST_CASE("attempts that cannot be evaluated or linearized end, and the next guess is tried") {
  const auto problem = from_functions(1, {parameter("p", 0)}, [](In u, In, Out F) {
    if (u[0] < -2) throw std::runtime_error("below -2");
    F[0] = std::sqrt(u[0]) * (u[0] - 4) * (u[0] - 9);
  });
  const auto found =
      sorted(deflate(*problem, Vector{{0.0}}, {}, {Vector{{-3.0}}, Vector{{-1.0}}, Vector{{5.0}}}));
  REQUIRE(found.size() >= 2);
  CHECK(std::abs(found[found.size() - 2] - 4) < 1e-8);
  CHECK(std::abs(found[found.size() - 1] - 9) < 1e-8);
  const auto flat = polynomial({-1, 1});  // its slope vanishes at 0
  CHECK(deflate(*flat, Vector{{0.0}}, {}, {Vector{{0.0}}}).empty());
  CHECK(deflate(*flat, Vector{{0.0}}, {}, {Vector{{0.0}}, Vector{{0.1}}}).size() == 2);
}

TEST_CASE("no more solutions are looked for than asked for") {
  CHECK(deflate(*polynomial({1, 2, 3, 4, 5}), Vector{{0.0}}, {}, {Vector{{0.3}}}, {.solutions = 3}).size() ==
        3);
}

TEST_CASE(
    "the autocatalator's isola is found at one residence time, and its folds are those of the closed form") {
  // Gray and Scott, Chem. Eng. Sci. 38 (1983): a = -a b^2 + (1 - a) / tau, b = a b^2 - k b - b / tau. Next to
  // a = 1, b = 0: b = (1 +- sqrt(1 - 4 (1 + k tau)^2 / tau)) / (2 (1 + k tau)), for 4 (1 + k tau)^2 <= tau.
  const double k = 1.0 / 40;
  const auto problem = from_functions(
      2, {parameter("tau", 50, 50)},
      [=](In u, In p, Out F) {
        const double rate = u[0] * u[1] * u[1];
        F[0] = -rate + (1 - u[0]) / p[0];
        F[1] = rate - k * u[1] - u[1] / p[0];
      },
      [=](In u, In p, Eigen::Ref<Matrix> J) {
        J << -u[1] * u[1] - 1 / p[0], -2 * u[0] * u[1], u[1] * u[1], 2 * u[0] * u[1] - k - 1 / p[0];
      });
  const Vector p{{50.0}}, washed_out{{1.0, 0.0}};
  const Branch trivial = trace(problem, {washed_out, p, 0, 1}, window(1, 400));
  for (const Point& point : trivial.points) REQUIRE((point.u - washed_out).norm() < 1e-12);

  const auto found = deflate(*problem, p, {washed_out}, {washed_out});
  REQUIRE(found.size() == 2);
  const double c = 1 + k * 50, root = std::sqrt(1 - 4 * c * c / 50);
  for (const double sign : {-1.0, 1.0}) {
    const double b = (1 + sign * root) / (2 * c);
    CHECK(
        std::any_of(found.begin(), found.end(), [&](const Vector& u) { return std::abs(u[1] - b) < 1e-10; }));
  }
  for (const Vector& u : found) {
    const Branch isola = trace(problem, {u, p, 0, 1}, window(1, 400), {fold_monitor()});
    CHECK(isola.stop.reason == StopReason::closed);
    REQUIRE(isola.events.size() == 2);
    const double middle = (0.25 - 2 * k) / (2 * k * k), half = std::sqrt(middle * middle - 1 / (k * k));
    const auto [low, high] = std::minmax(isola.events[0].point.parameter, isola.events[1].point.parameter);
    CHECK(std::abs(low / (middle - half) - 1) < 1e-10);
    CHECK(std::abs(high / (middle + half) - 1) < 1e-10);
    for (const Point& point : isola.points) {
      const double t = point.parameter, b = point.u[1];
      REQUIRE(std::abs((1 + k * t) * (b * b + 1 / t) - b) < 1e-10);
    }
  }
}

TEST_CASE("a circle apart from a line is found from the line") {
  const auto problem = from_functions(1, {parameter("lambda", 2)}, [](In u, In p, Out F) {
    F[0] = (u[0] * u[0] + std::pow(p[0] - 2, 2) - 0.25) * (u[0] - 3 - p[0]);
  });
  const Vector p{{2.0}};
  const auto found = sorted(deflate(*problem, p, {Vector{{5.0}}}, {Vector{{5.0}}}));
  REQUIRE(found.size() == 2);
  CHECK(std::abs(found[0] + 0.5) < 1e-9);
  CHECK(std::abs(found[1] - 0.5) < 1e-9);
  const Branch circle = trace(problem, {Vector{{found[0]}}, p, 0, 1}, window(0, 4), {fold_monitor()});
  CHECK(circle.stop.reason == StopReason::closed);
  REQUIRE(circle.events.size() == 2);
  CHECK(std::abs(circle.events[0].point.parameter - 2.5) < 1e-10);
  CHECK(std::abs(circle.events[1].point.parameter - 1.5) < 1e-10);
}

TEST_CASE("sizes and options that do not fit are refused") {
  const auto problem = polynomial({-1, 1});
  const Vector p{{0.0}}, u{{1.0}};
  CHECK_THROWS_AS(deflate(*problem, Vector(0), {}, {u}), std::invalid_argument);
  CHECK_THROWS_AS(deflate(*problem, p, {Vector(2)}, {u}), std::invalid_argument);
  CHECK_THROWS_AS(deflate(*problem, p, {}, {Vector(2)}), std::invalid_argument);
  CHECK_THROWS_AS(deflate(*problem, p, {}, {Vector{{std::nan("")}}}), std::invalid_argument);
  CHECK_THROWS_AS(deflate(*problem, p, {}, {u}, {.tolerance = 0}), std::invalid_argument);
  CHECK_THROWS_AS(deflate(*problem, p, {}, {u}, {.tolerance = 1e-6}), std::invalid_argument);
  CHECK_THROWS_AS(deflate(*problem, p, {}, {u}, {.iterations = 0}), std::invalid_argument);
  CHECK_THROWS_AS(deflate(*problem, p, {}, {u}, {.largest_step = -1}), std::invalid_argument);
  CHECK_THROWS_AS(deflate(*problem, p, {}, {u}, {.apart = 0}), std::invalid_argument);
  CHECK_THROWS_AS(deflate(*problem, p, {}, {u}, {.solutions = 0}), std::invalid_argument);
}
