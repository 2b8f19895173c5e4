#include <arcslip/continuation/special_points/multiple_point.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/special_points/lyapunov_schmidt.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr int iterations = 12;
constexpr double converged_at = 1e-12;     // of a correction of x in scales, relative to 1 + |u|
constexpr double least_separation = 1e-7;  // of branches, relative, that are not resolved
constexpr double singular_share = 1e-6;    // ratio of the smallest to the largest singular value of the form
constexpr double sphere = 1e-2;            // r, relative to 1 + |u|: where the branches are found
constexpr double zero_of_forms = 1e-12;    // of the forms on the sphere, relative
constexpr double isolated = 1e-4;          // of r: the least singular value at a zero, relative
constexpr double same_zero = 1e-3;         // closer zeros of the forms are the same
constexpr double opposite = 0.99;          // cosine of two half-branches of one branch
constexpr int newton_steps = 60;

// Reproducible pseudorandom numbers in [-1, 1].
class Scatter {
 public:
  Vector on_sphere(Eigen::Index n) {
    Vector y(n);
    do
      for (double& each : y) each = next();
    while (!(y.norm() > 0.1 && y.norm() <= 1));
    return y.normalized();
  }

 private:
  double next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1;
  }
  std::uint64_t state_ = 1;
};

// The homogeneous polynomials in y of one degree, in a fixed order.
class Monomials {
 public:
  Monomials(Eigen::Index variables, int degree) {
    std::vector<int> now;
    fill(static_cast<int>(variables), degree, 0, now);
  }
  Eigen::Index size() const { return static_cast<Eigen::Index>(factors_.size()); }
  Vector operator()(const Vector& y) const {
    Vector values(size());
    for (Eigen::Index i = 0; i < size(); ++i) {
      values[i] = 1;
      for (const int j : factors_[static_cast<std::size_t>(i)]) values[i] *= y[j];
    }
    return values;
  }
  Matrix gradient(const Vector& y) const {
    Matrix values = Matrix::Zero(size(), y.size());
    for (Eigen::Index i = 0; i < size(); ++i) {
      const auto& factors = factors_[static_cast<std::size_t>(i)];
      for (std::size_t k = 0; k < factors.size(); ++k) {
        double others = 1;
        for (std::size_t l = 0; l < factors.size(); ++l)
          if (l != k) others *= y[factors[l]];
        values(i, factors[k]) += others;
      }
    }
    return values;
  }

 private:
  void fill(int variables, int left, int from, std::vector<int>& now) {
    if (left == 0) return factors_.push_back(now);
    for (int j = from; j < variables; ++j) {
      now.push_back(j);
      fill(variables, left - 1, j, now);
      now.pop_back();
    }
  }
  std::vector<std::vector<int>> factors_;
};

// beta(r y) / r^2 = Q(y) + r K(y), fitted to values on the sphere of radius r.
class Forms {
 public:
  explicit Forms(Eigen::Index variables) : second_(variables, 2), third_(variables, 3) {}

  bool fit(LyapunovSchmidt& reduction, double r) {
    const Eigen::Index k = reduction.right().cols(), m = k - 1;
    const Eigen::Index samples = 2 * third_.size() + 4;
    Matrix A2(samples, second_.size()), A3(samples, third_.size()), even(samples, m), odd(samples, m);
    Scatter scatter;
    Vector place;
    for (Eigen::Index i = 0; i < samples; ++i) {
      const Vector y = scatter.on_sphere(k);
      const Vector plus = reduction.beta(r * y, place), minus = reduction.beta(-r * y, place);
      if (!plus.allFinite() || !minus.allFinite()) return false;
      A2.row(i) = second_(y).transpose();
      A3.row(i) = third_(y).transpose();
      even.row(i) = (plus + minus).transpose() / (2 * r * r);
      odd.row(i) = (plus - minus).transpose() / (2 * r * r * r);
    }
    Q_ = least_squares(A2, even).X;
    K_ = least_squares(A3, odd).X;
    size_ = Q_.norm() + r * K_.norm();
    return Q_.allFinite() && K_.allFinite() && size_ > 0;
  }

  double size() const { return size_; }
  Vector value(const Vector& y, double r) const {
    return Q_.transpose() * second_(y) + r * (K_.transpose() * third_(y));
  }
  // Gradients of the forms and of |y|^2 / 2.
  Matrix gradient(const Vector& y, double r) const {
    Matrix D(y.size(), y.size());
    D.topRows(y.size() - 1) =
        Q_.transpose() * second_.gradient(y) + r * (K_.transpose() * third_.gradient(y));
    D.bottomRows(1) = size_ * y.transpose();
    return D;
  }

 private:
  Monomials second_, third_;
  Matrix Q_, K_;  // a column for each equation
  double size_ = 0;
};

// All zeros of the forms on the unit sphere. Nothing if they are not isolated.
std::optional<std::vector<Vector>> zeros(const Forms& forms, Eigen::Index k, double r) {
  const int starts = k == 3 ? 600 : 6000;
  Scatter scatter;
  std::vector<Vector> found;
  for (int i = 0; i < starts; ++i) {
    Vector y = scatter.on_sphere(k), g(k);
    bool reached = false;
    for (int step = 0; step < newton_steps && !reached; ++step) {
      g << forms.value(y, r), 0;
      reached = g.norm() <= zero_of_forms * forms.size();
      const Vector dy = solve(forms.gradient(y, r), g);
      if (!dy.allFinite()) break;
      y -= dy / std::max(1.0, 2 * dy.norm());
      y.normalize();
    }
    if (!reached) continue;
    if (std::any_of(found.begin(), found.end(),
                    [&](const Vector& other) { return (y - other).norm() < same_zero * std::max(1e-2, r); }))
      continue;
    const auto values = singular_values(forms.gradient(y, r)).values;
    if (values[k - 1] < isolated * r * values[0]) return {};
    found.push_back(std::move(y));
    if (found.size() > 200) return {};
  }
  return found;
}

// Corrects a zero of the forms to the zero of beta itself at radius r.
bool correct(LyapunovSchmidt& reduction, const Forms& forms, double r, Vector& y, Vector& place) {
  const Eigen::Index k = y.size();
  Vector g(k);
  double before = 0;
  for (int step = 0; step < newton_steps; ++step) {
    g << reduction.beta(r * y, place) / (r * r), 0;
    if (!g.allFinite()) return false;
    const Vector dy = solve(forms.gradient(y, r), g);
    const double now = dy.norm();
    if (!(now < 0.5) || (step > 1 && now > before)) return step > 1 && before < 1e-6;
    y = (y - dy).normalized();
    if (now < 1e-13) return true;
    before = now;
  }
  return before < 1e-6;
}

// The directions in which branches leave: those to their points at r, r/2 and r/4, extrapolated to 0.
std::optional<std::vector<Vector>> half_branches(LyapunovSchmidt& reduction) {
  const Eigen::Index k = reduction.right().cols();
  const double r = sphere * (1 + reduction.size());
  Forms forms(k);
  if (!forms.fit(reduction, r)) return {};
  const auto all = zeros(forms, k, r);
  if (!all) return {};
  const Vector& scale = reduction.scales();
  std::vector<Vector> found;
  for (Vector y : *all) {
    std::array<Vector, 3> direction;
    Vector place;
    double radius = r;
    for (Vector& each : direction) {
      if (!correct(reduction, forms, radius, y, place)) return {};
      each = (place - reduction.x()).cwiseQuotient(scale).normalized();
      radius /= 2;
    }
    const Vector t = (direction[0] - 6 * direction[1] + 8 * direction[2]).normalized();
    found.push_back(t.cwiseProduct(scale));
  }
  return found;
}

// The rows of G, one below the other.
Vector stacked_gradient(const LyapunovSchmidt& reduction) {
  const Matrix& G = reduction.gradient();
  Vector g(G.size());
  for (Eigen::Index i = 0; i < G.rows(); ++i) g.segment(i * G.cols(), G.cols()) = G.row(i).transpose();
  return g;
}

// beta where the reduction is moved to x, with G and H at the point beyond. Nothing on failure.
std::optional<Vector> expand(LyapunovSchmidt& reduction, const Vector& x, Matrix& H) {
  if (!reduction.move_to(x)) return {};
  Vector beta = reduction.settle();
  if (!beta.allFinite() || !reduction.move_to(reduction.x()) || !reduction.form(H)) return {};
  return beta;
}

// Newton's method for G = 0, in the plane of the reduction. Nothing if it leads farther away than `reach`.
std::optional<Vector> zero_of_gradient(LyapunovSchmidt& reduction, const Vector& guess, double reach) {
  Vector x = guess;
  Matrix H;
  for (int step = 0; step < iterations; ++step) {
    if (!expand(reduction, x, H)) return {};
    const LeastSquares found = least_squares(H, stacked_gradient(reduction), singular_share);
    if (found.rank < reduction.gradient().cols()) return {};
    const Vector y = found.X;
    x = reduction.x() + reduction.right() * y;
    if (!((x - guess).cwiseQuotient(reduction.scales()).norm() <= reach)) return {};
    if (y.norm() <= converged_at * (1 + reduction.size())) break;
  }
  return x;
}

// Whether beta and G vanish at x, compared with H.
bool is_multiple(LyapunovSchmidt& reduction, const Vector& x) {
  Matrix H;
  const auto beta = expand(reduction, x, H);
  const double distance = least_separation * (1 + reduction.size());
  return beta && stacked_gradient(reduction).norm() <= H.norm() * distance &&
         beta->norm() <= H.norm() * distance * distance;
}

}  // namespace

std::optional<MultiplePoint> locate_multiple_point(const Problem& problem, const Vector& p, int along,
                                                   const Vector& guess, int rank_loss, double reach,
                                                   const MakeLinearSolver& make_solver) {
  if (rank_loss < 2 || rank_loss > largest_rank_loss || rank_loss > problem.size()) return {};
  LyapunovSchmidt reduction(problem, p, along, rank_loss, make_solver);
  const auto x = zero_of_gradient(reduction, guess, reach);
  if (!x || !is_multiple(reduction, *x)) return {};
  const auto directions = half_branches(reduction);
  if (!directions) return {};
  MultiplePoint point;
  point.x = reduction.x();
  point.rank_loss = rank_loss;
  const auto cosine = [&](const Vector& a, const Vector& b) {
    return a.cwiseQuotient(reduction.scales()).dot(b.cwiseQuotient(reduction.scales()));
  };
  for (const Vector& each : *directions)
    if (std::none_of(point.tangents.begin(), point.tangents.end(),
                     [&](const Vector& other) { return cosine(each, other) < -opposite; }))
      point.tangents.push_back(each);
  return point;
}

}  // namespace arcslip::continuation
