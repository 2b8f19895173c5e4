// A linear solver of one's own: the Jacobian of Bratu's problem in the unit square (examples/bratu_2d) is
// only applied, never stored, and MINRES, which takes symmetric matrices that need not be definite, solves
// with it. block_elimination() makes of it a solver for continuation, which passes the fold, where J is
// singular.
//
//   iterative_solver [k = 48]

#include <arcslip/continuation.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace arcslip::continuation;

namespace {

// Paige, Saunders: Solution of sparse indefinite systems of linear equations, SIAM J. Numer. Anal. 12, 1975.
class Minres final : public PlainSolver {
 public:
  const char* name() const override { return "MINRES"; }

  bool prepare(const Jacobian& J) override {
    J_ = &J;  // nothing else: there is no preconditioner
    return true;
  }

  bool solve(In b, Out x) const override {
    double residual = b.norm(), beta = 0, cosine = -1, sine = 0, delta = 0, epsilon = 0;
    const double enough = tolerance * residual;
    x.setZero();
    v_ = b / std::max(residual, 1e-300);
    old_v_ = old_d_ = d_ = Vector::Zero(b.size());
    next_.resize(b.size());
    for (int k = 0; residual > enough; ++k) {
      if (k == iterations) return false;
      apply(*J_, v_, next_);
      next_ += shift * v_;
      const double alpha = v_.dot(next_);
      next_ -= alpha * v_ + beta * old_v_;
      beta = next_.norm();
      const double above = cosine * delta + sine * alpha;
      const double on = sine * delta - cosine * alpha, pivot = std::hypot(on, beta);
      old_d_ = (v_ - above * d_ - epsilon * old_d_) / pivot;
      std::swap(d_, old_d_);
      epsilon = sine * beta;
      delta = -cosine * beta;
      cosine = on / pivot;
      sine = beta / pivot;
      x += cosine * residual * d_;
      residual *= sine;
      old_v_ = v_;
      v_ = next_ / std::max(beta, 1e-300);
    }
    return true;
  }

 private:
  static constexpr double tolerance = 1e-8;
  static constexpr int iterations = 5000;
  // Where J is singular there is no solution. J + shift has one, and the refinement in block_elimination()
  // goes by J itself.
  static constexpr double shift = 1e-6;
  const Jacobian* J_ = nullptr;
  mutable Vector v_, old_v_, next_, d_, old_d_;
};

}  // namespace

int main(int argc, char** argv) {
  const int k = argc > 1 ? std::atoi(argv[1]) : 48, n = k * k;
  const double h = 1.0 / (k + 1);
  // y = -h^2 times the Laplacian of x; the boundary is 0.
  const auto laplacian = [=](In x, Out y) {
    y = 4 * x;
    y.head(n - k) -= x.tail(n - k);
    y.tail(n - k) -= x.head(n - k);
    for (int line = 0; line < n; line += k) {
      y.segment(line, k - 1) -= x.segment(line + 1, k - 1);
      y.segment(line + 1, k - 1) -= x.segment(line, k - 1);
    }
  };

  long products = 0;
  Functions bratu;
  bratu.size = n;
  bratu.parameters = {{"lambda", "", 0.1}};
  bratu.scales = Vector::Constant(n, k);  // distances are root mean squares of u
  bratu.residual = [=](In u, In p, Out F) {
    laplacian(u, F);
    F.array() -= h * h * p[0] * u.array().exp();
  };
  bratu.apply_jacobian = [=, &products](In u, In p, In x, Out y) {
    ++products;
    laplacian(x, y);
    y.array() -= h * h * p[0] * u.array().exp() * x.array();
  };
  bratu.derivative = [=](In u, In, int, Out dF) { dF = -h * h * u.array().exp(); };
  bratu.linear_solver = [] { return block_elimination(std::make_unique<Minres>()); };
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
  const Branch branch = trace(problem, start, options, {fold_monitor()}, print);
  std::printf("%ld points, %ld solves, %ld products with J; %s\n", branch.counts.points, branch.counts.solves,
              products, branch.stop.message.c_str());
  return branch.events.empty();
}
