// Bratu's problem in the unit square, u_xx + u_yy + lambda exp(u) = 0, u = 0 on the boundary, by the
// five-point formula on k x k inner points: through its fold at lambda = 6.808124.
//
//   bratu_2d [k = 256]

#include <arcslip/continuation.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

using namespace arcslip::continuation;

namespace {

// -h^2 times the Laplacian on k x k points.
SparseMatrix laplacian(int k) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int x = 0; x < k; ++x)
    for (int y = 0; y < k; ++y) {
      const int i = x * k + y;
      entries.emplace_back(i, i, 4);
      if (x > 0) entries.emplace_back(i, i - k, -1);
      if (x + 1 < k) entries.emplace_back(i, i + k, -1);
      if (y > 0) entries.emplace_back(i, i - 1, -1);
      if (y + 1 < k) entries.emplace_back(i, i + 1, -1);
    }
  SparseMatrix L(k * k, k * k);
  L.setFromTriplets(entries.begin(), entries.end());
  return L;
}

}  // namespace

int main(int argc, char** argv) {
  const int k = argc > 1 ? std::atoi(argv[1]) : 256, n = k * k;
  const double h = 1.0 / (k + 1);
  const SparseMatrix L = laplacian(k);

  Functions bratu;
  bratu.size = n;
  bratu.parameters = {{"lambda", "", 0.1}};
  bratu.scales = Vector::Constant(n, k);  // distances are root mean squares of u
  bratu.residual = [=](In u, In p, Out F) {
    F = -h * h * p[0] * u.array().exp();
    F.noalias() += L * u;
  };
  bratu.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    if (J.nonZeros() == 0) J = L;
    for (int i = 0; i < n; ++i) J.coeffRef(i, i) = 4 - h * h * p[0] * std::exp(u[i]);
  };
  bratu.derivative = [=](In u, In, int, Out dF) { dF = -h * h * u.array().exp(); };
  const auto problem = from_functions(std::move(bratu));

  std::printf("    lambda         max u\n");
  int points = 0;
  const auto print = [&](const Accepted& at, const Event* event) {
    const double lambda = at.p[0], top = at.u.maxCoeff();
    if (event)
      std::printf("%.12f  %.6f  fold at lambda = %.12f\n", lambda, top, lambda);
    else if (points++ % 10 == 0)
      std::printf("%.12f  %.6f\n", lambda, top);
    return top < 2 || lambda > 5;
  };
  const Start start{.u = Vector::Zero(n), .p = parameter_values(*problem)};
  Options options{.lower = 0, .upper = 8};
  options.step.largest_parameter = 0.5;
  options.step.contraction =
      0.1;  // shorter steps, whose chord steps spare the factors: they are the price here
  const Branch branch = trace(problem, start, options, {fold_monitor()}, print);
  std::printf("%ld points, %ld factorizations, %ld solves; %s\n", branch.counts.points,
              branch.counts.factorizations, branch.counts.solves, branch.stop.message.c_str());
  return branch.events.empty();
}
