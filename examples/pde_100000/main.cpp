// Heat and reactant in a slab of catalyst (Weisz, Hicks: Chem. Eng. Sci. 17, 1962): with c the concentration,
// T the temperature, both relative to the surface, x from the centre to the surface,
//
//   c'' = Lambda c exp(gamma (1 - 1/T)),   T'' = -beta Lambda c exp(gamma (1 - 1/T)),
//   c' = T' = 0 at x = 0,   c = T = 1 at x = 1,
//
// gamma = 20, beta = 0.4, over Lambda, the square of Thiele's modulus. Between two folds there are three
// states: a cold one, a hot one, and an unstable one. By central differences on k points, two unknowns each.
//
//   pde_100000 [k = 50000]

#include <arcslip/continuation.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

using namespace arcslip::continuation;

namespace {

constexpr double gamma = 20, beta = 0.4;

// c exp(gamma (1 - 1/T)) with its derivatives.
struct Rate {
  Rate(double c, double T) {
    by_c = std::exp(gamma * (1 - 1 / T));
    value = c * by_c;
    by_T = value * gamma / (T * T);
  }
  double value, by_c, by_T;
};

// Unknowns c_0, T_0, c_1, T_1, ... at x = (i + 1/2) h: the centre is between the first point and its image,
// the surface between the last one and its image, where c = T = 1 is their mean.
void residual(In u, double factor, Out F) {
  const Eigen::Index n = u.size();
  for (Eigen::Index i = 0; i < n; i += 2) {
    const double rate = factor * Rate(u[i], u[i + 1]).value;
    for (Eigen::Index j = i; j < i + 2; ++j) {
      const double before = j >= 2 ? u[j - 2] : u[j];
      const double after = j + 2 < n ? u[j + 2] : 2 - u[j];
      F[j] = 2 * u[j] - before - after + (j == i ? rate : -beta * rate);
    }
  }
}

SparseMatrix diffusion(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < n; ++j) {
    entries.emplace_back(j, j, j < 2 ? 1 : j + 2 < n ? 2 : 3);
    if (j >= 2) entries.emplace_back(j, j - 2, -1);
    if (j + 2 < n) entries.emplace_back(j, j + 2, -1);
    entries.emplace_back(j, j ^ 1, 0);  // the other unknown of the point, by the reaction
  }
  SparseMatrix J(n, n);
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

}  // namespace

int main(int argc, char** argv) {
  const int k = argc > 1 ? std::atoi(argv[1]) : 50000, n = 2 * k;
  const double h = 1.0 / k;
  const SparseMatrix D = diffusion(n);

  Functions slab;
  slab.size = n;
  slab.parameters = {{"Lambda", "", 0.01}};
  slab.scales = Vector::Constant(n, std::sqrt(n));  // distances are root mean squares
  slab.residual = [=](In u, In p, Out F) { residual(u, h * h * p[0], F); };
  slab.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    J = D;
    for (int i = 0; i < n; i += 2) {
      const Rate rate(u[i], u[i + 1]);
      const double factor = h * h * p[0];
      J.coeffRef(i, i) += factor * rate.by_c;
      J.coeffRef(i, i + 1) += factor * rate.by_T;
      J.coeffRef(i + 1, i) -= beta * factor * rate.by_c;
      J.coeffRef(i + 1, i + 1) -= beta * factor * rate.by_T;
    }
  };
  slab.derivative = [=](In u, In, int, Out dF) {
    for (int i = 0; i < n; i += 2) {
      dF[i] = h * h * Rate(u[i], u[i + 1]).value;
      dF[i + 1] = -beta * dF[i];
    }
  };
  const auto problem = from_functions(std::move(slab));

  std::printf("    Lambda      c and T at the centre\n");
  int points = 0;
  const auto print = [&](const Accepted& at, const Event* event) {
    if (event)
      std::printf("%.12f  %.6f  %.6f  fold at Lambda = %.12f\n", at.p[0], at.u[0], at.u[1], at.p[0]);
    else if (points++ % 25 == 0)
      std::printf("%.12f  %.6f  %.6f\n", at.p[0], at.u[0], at.u[1]);
    return true;
  };
  const Start start{.u = Vector::Ones(n), .p = parameter_values(*problem)};
  const Branch branch = trace(problem, start, {.lower = 0, .upper = 1.5}, {fold_monitor()}, print);
  std::printf("%ld points, %ld factorizations, %ld solves; %s\n", branch.counts.points,
              branch.counts.factorizations, branch.counts.solves, branch.stop.message.c_str());
  return branch.events.size() != 2;
}
