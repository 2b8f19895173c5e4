// Branches that come near each other: the true one is known by the sign of u.

#include "catch.hpp"

#include "continuation/suite/cases.hpp"

#include <cmath>

using namespace suite;
using arcslip::continuation::fold_monitor;
using arcslip::continuation::Point;
using arcslip::continuation::StopReason;

namespace {

std::vector<Options> step_settings() {
  std::vector<Options> all(4, window(-1, 1));
  all[1].step.largest_parameter = 0.002;
  all[2].step.largest_parameter = 0.3;
  all[3].step.initial = 0.3;
  return all;
}

struct Follow {
  ProblemPtr problem;
  double lambda, u;                           // start
  std::optional<double> fold;                 // in lambda
  double (*lambda_of)(double u, double eps);  // closed form
  double eps;
};

void check(const Follow& f, int n = 1) {
  const auto first = [n](const Vector& u) {  // y_0 of u = Q y
    const Vector h = Vector::LinSpaced(n, 1, n);
    return n == 1 ? u[0] : u[0] - 2 * h.dot(u) / h.squaredNorm();
  };
  for (const Options& options : step_settings()) {
    CAPTURE(n, f.eps, f.lambda, f.u, options.step.largest_parameter, options.step.initial);
    const Vector start = n == 1 ? Vector::Constant(1, f.u) : turned_pitchfork_state(n, f.u);
    const Branch branch = arcslip::continuation::trace(
        f.problem, {start, Vector{{f.lambda, f.eps}}, 0, f.lambda < 0 ? 1 : -1}, options, {fold_monitor()});
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.points.back().parameter == (f.fold ? f.lambda : -f.lambda));
    double worst = 0;
    bool same_side = true;
    for (const Point& point : branch.points) {
      const double y = first(point.u);
      same_side = same_side && y * f.u > 0;
      worst = std::max(worst, std::abs(f.lambda_of(y, f.eps) - point.parameter));
    }
    CHECK(same_side);
    CHECK(worst < 1e-10);
    const auto found = folds(branch);
    REQUIRE(found.size() == (f.fold ? 1 : 0));
    if (f.fold) CHECK(std::abs(found[0].point.parameter / *f.fold - 1) < 1e-11);
  }
}

double pitchfork_lambda(double u, double eps) {
  return u * u - eps / u;
}

double transcritical_lambda(double u, double eps) {
  return u - eps / u;
}

}  // namespace

TEST_CASE(
    "the imperfect pitchfork is followed on its true branch, eps = +-1e-2 to +-1e-8, from four starts") {
  for (int k = 2; k <= 8; ++k)
    for (int sign : {1, -1}) {
      const double eps = sign * std::pow(10, -k), fold = 3 * std::pow(std::abs(eps) / 2, 2.0 / 3);
      const ProblemPtr problem = pitchfork(eps);
      check({problem, -1, eps, {}, pitchfork_lambda, eps});             // through, from the left
      check({problem, 1, double(sign), {}, pitchfork_lambda, eps});     // through, from the right
      check({problem, 1, double(-sign), fold, pitchfork_lambda, eps});  // back at the fold, from outside
      check({problem, 1, -eps, fold, pitchfork_lambda, eps});           // and from the middle
    }
}

TEST_CASE("the same pitchfork in three and in eight turned coordinates is followed on its true branch") {
  for (int n : {3, 8})
    for (int k = 2; k <= 8; ++k)
      for (int sign : {1, -1}) {
        const double eps = sign * std::pow(10, -k), fold = 3 * std::pow(std::abs(eps) / 2, 2.0 / 3);
        const ProblemPtr problem = turned_pitchfork(n, eps);
        check({problem, -1, eps, {}, pitchfork_lambda, eps}, n);
        check({problem, 1, double(sign), {}, pitchfork_lambda, eps}, n);
        check({problem, 1, double(-sign), fold, pitchfork_lambda, eps}, n);
        check({problem, 1, -eps, fold, pitchfork_lambda, eps}, n);
      }
}

TEST_CASE(
    "the imperfect transcritical is followed on its true branch: open for eps > 0, folded for eps < 0") {
  for (int k = 2; k <= 8; ++k) {
    const double eps = std::pow(10, -k), fold = 2 * std::sqrt(eps);
    const ProblemPtr open = transcritical(eps), folded = transcritical(-eps);
    check({open, -1, eps, {}, transcritical_lambda, eps});
    check({open, -1, -1, {}, transcritical_lambda, eps});
    check({open, 1, 1, {}, transcritical_lambda, eps});
    check({open, 1, -eps, {}, transcritical_lambda, eps});
    check({folded, 1, 1, fold, transcritical_lambda, -eps});
    check({folded, 1, eps, fold, transcritical_lambda, -eps});
    check({folded, -1, -1, -fold, transcritical_lambda, -eps});
    check({folded, -1, -eps, -fold, transcritical_lambda, -eps});
  }
}
