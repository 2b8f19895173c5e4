// Bratu's problem u'' + lambda exp(u) = 0 on (0, 1), u(0) = u(1) = 0, by central differences on n inner
// points: a branch of n unknowns through its fold, whose place is known, lambda = 3.513830719125.
//
//   bratu [n = 100000]

#include <arcslip/continuation.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace arcslip::continuation;

int main(int argc, char** argv) {
  const int n = argc > 1 ? std::atoi(argv[1]) : 100000;
  const double h = 1.0 / (n + 1);

  Functions bratu;
  bratu.size = n;
  bratu.parameters = {{"lambda", "", 0.1}};
  // Distances on the branch are then root mean squares of u, whatever n is.
  bratu.scales = Vector::Constant(n, std::sqrt(n));
  bratu.residual = [=](In u, In p, Out F) {
    // First differences are exact in floating point; 2 u_i - u_(i-1) - u_(i+1) rounds by 1e-16/h^2.
    for (int i = 0; i < n; ++i) {
      const double left = i > 0 ? u[i] - u[i - 1] : u[i], right = i + 1 < n ? u[i] - u[i + 1] : u[i];
      F[i] = left + right - h * h * p[0] * std::exp(u[i]);
    }
  };
  bratu.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    if (J.nonZeros() == 0) {  // the pattern, once
      J.reserve(Eigen::VectorXi::Constant(n, 3));
      for (int i = 0; i < n; ++i) {
        if (i > 0) J.insert(i - 1, i) = -1;
        J.insert(i, i) = 2;
        if (i + 1 < n) J.insert(i + 1, i) = -1;
      }
      J.makeCompressed();
    }
    for (int i = 0; i < n; ++i)
      J.valuePtr()[J.outerIndexPtr()[i] + (i > 0)] = 2 - h * h * p[0] * std::exp(u[i]);
  };
  bratu.derivative = [=](In u, In, int, Out dF) { dF = -h * h * u.array().exp(); };
  const auto problem = from_functions(std::move(bratu));

  std::printf("    lambda         max u\n");
  int points = 0;
  const auto print = [&](const Accepted& at, const Event* event) {
    const double lambda = at.p[0], top = at.u.maxCoeff();
    if (event)
      std::printf("%.12f  %.6f  fold at lambda = %.12f\n", lambda, top, lambda);
    else if (points++ % 25 == 0)
      std::printf("%.12f  %.6f\n", lambda, top);
    return top < 2 || lambda > 1;  // to lambda = 1 on the upper branch
  };
  const Start start{.u = Vector::Zero(n), .p = parameter_values(*problem)};
  const Branch branch = trace(problem, start, {.lower = 0, .upper = 4}, {fold_monitor()}, print);
  std::printf("%ld points, %ld factorizations, %ld solves; %s\n", branch.counts.points,
              branch.counts.factorizations, branch.counts.solves, branch.stop.message.c_str());
  return branch.events.empty();
}
