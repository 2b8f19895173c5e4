#include "branches.hpp"

#include <arcslip/continuation/problem/problem_from_functions.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <cmath>
#include <stdexcept>

namespace arcslip::bench {
namespace {

using namespace continuation;
using Matrix = Eigen::Ref<Eigen::MatrixXd>;

Parameter parameter(std::string name) {
  return {std::move(name), "", 0, 1, -1e300, 1e300};
}

Options window(double lower, double upper) {
  Options options;
  options.lower = lower;
  options.upper = upper;
  return options;
}

// mu + lambda x - x^3 = 0, lambda = 1
Case cusp() {
  const auto problem = from_functions(
      1, {parameter("mu"), parameter("lambda")},
      [](In u, In p, Out F) { F[0] = p[0] + p[1] * u[0] - u[0] * u[0] * u[0]; },
      [](In u, In p, Matrix J) { J(0, 0) = p[1] - 3 * u[0] * u[0]; },
      [](In u, In, int k, Out dF) { dF[0] = k == 0 ? 1 : u[0]; });
  return {problem, {Vector{{-1.5213797068045676}}, Vector{{-2, 1}}, 0, 1}, window(-2, 2), 2};
}

// -x + p1 (1 - x) e^y = 0, -y + p1 p2 (1 - x) e^y - p3 y = 0, p2 = 14, p3 = 2
Case ab() {
  const auto problem = from_functions(
      2, {parameter("p1"), parameter("p2"), parameter("p3")},
      [](In u, In p, Out F) {
        const double rate = p[0] * (1 - u[0]) * std::exp(u[1]);
        F[0] = -u[0] + rate;
        F[1] = -u[1] + p[1] * rate - p[2] * u[1];
      },
      [](In u, In p, Matrix J) {
        const double e = p[0] * std::exp(u[1]), rate = e * (1 - u[0]);
        J(0, 0) = -1 - e;
        J(0, 1) = rate;
        J(1, 0) = -p[1] * e;
        J(1, 1) = -1 + p[1] * rate - p[2];
      },
      [](In u, In p, int k, Out dF) {
        const double e = (1 - u[0]) * std::exp(u[1]);
        dF[0] = k == 0 ? e : 0;
        dF[1] = k == 0 ? p[1] * e : k == 1 ? p[0] * e : -u[1];
      });
  return {problem, {Vector::Zero(2), Vector{{0, 14, 2}}, 0, 1}, window(0, 0.15), 2};
}

// x1 - x2^3 + 5 x2^2 - 2 x2 - 13 + 34 (x3 - 1) = 0, x1 + x2^3 + x2^2 - 14 x2 - 29 + 10 (x3 - 1) = 0
Case freudenstein_roth() {
  const auto problem = from_functions(
      2, {parameter("x3")},
      [](In u, In p, Out F) {
        const double y = u[1];
        F[0] = u[0] + ((5 - y) * y - 2) * y - 13 + 34 * (p[0] - 1);
        F[1] = u[0] + ((1 + y) * y - 14) * y - 29 + 10 * (p[0] - 1);
      },
      [](In u, In, Matrix J) {
        const double y = u[1];
        J(0, 0) = J(1, 0) = 1;
        J(0, 1) = (10 - 3 * y) * y - 2;
        J(1, 1) = (2 + 3 * y) * y - 14;
      },
      [](In, In, int, Out dF) {
        dF[0] = 34;
        dF[1] = 10;
      });
  return {problem, {Vector{{15, -2}}, Vector{{0}}, 0, 1}, window(-1, 1.5), 2};
}

// T_0 = T_{n-1} = 0, T_{i-1} - 2 T_i + T_{i+1} + alpha h^2 (1 + (T_i + T_i^2/2) / (1 + T_i^2/100)) = 0
Case chan() {
  constexpr int n = 100;
  constexpr double h2 = 1.0 / ((n - 1) * (n - 1));
  const auto rate = [](double T) { return 1 + (T + T * T / 2) / (1 + T * T / 100); };
  const auto slope = [](double T) {
    const double d = 1 + T * T / 100;
    return ((1 + T) * d - (T + T * T / 2) * T / 50) / (d * d);
  };
  const auto problem = from_functions(
      n, {parameter("alpha")},
      [=](In u, In p, Out F) {
        F[0] = u[0];
        F[n - 1] = u[n - 1];
        for (int i = 1; i + 1 < n; ++i) F[i] = u[i - 1] - 2 * u[i] + u[i + 1] + p[0] * h2 * rate(u[i]);
      },
      [=](In u, In p, Matrix J) {
        J.setZero();
        J(0, 0) = J(n - 1, n - 1) = 1;
        for (int i = 1; i + 1 < n; ++i) {
          J(i, i - 1) = J(i, i + 1) = 1;
          J(i, i) = -2 + p[0] * h2 * slope(u[i]);
        }
      },
      [=](In u, In, int, Out dF) {
        dF[0] = dF[n - 1] = 0;
        for (int i = 1; i + 1 < n; ++i) dF[i] = h2 * rate(u[i]);
      });
  return {problem, {Vector::Zero(n), Vector{{0}}, 0, 1}, window(0, 5), 2};
}

// x'' + 0.1 x' + x + x^3 = 0.1 cos wt
Case duffing(int order) {
  scene::Scene scene = scene::read_file("bench/auto07p/duffing.json", studies::catalogue());
  scene.harmonics.order = order;
  const auto model = std::make_shared<const model::Model>(model::build(scene));
  const Options options = window(0.5, 1.6);
  const auto problem =
      std::make_shared<const hbm::HbmProblem>(model, model->harmonics, 1.0, options.upper - options.lower);
  const Vector p = hbm::parameters_at(*problem, options.lower);
  const auto start = hbm::steady_state(problem, p).u;
  if (!start) throw std::runtime_error("no periodic response at the start");
  return {problem, {*start, p, model::frequency, 1}, options, 2};
}

}  // namespace

Case branch_case(const std::string& name) {
  if (name == "cusp") return cusp();
  if (name == "ab") return ab();
  if (name == "freudenstein_roth") return freudenstein_roth();
  if (name == "chan") return chan();
  if (name.starts_with("duffing/")) return duffing(std::stoi(name.substr(8)));
  throw std::invalid_argument("no branch is called \"" + name +
                              "\": cusp, ab, freudenstein_roth, chan, duffing/N");
}

}  // namespace arcslip::bench
