#include <arcslip/continuation/events/hopf.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/normal_forms/codimension_two.hpp>
#include <arcslip/continuation/special_points/augmented_evaluator.hpp>
#include <arcslip/continuation/special_points/curve_place.hpp>
#include <arcslip/continuation/special_points/hopf_curve.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <string>

namespace arcslip::continuation {
namespace {

// The square of the frequency at a point of a curve of Hopf points.
double square_of_frequency(const Accepted& now) {
  return now.u[now.u.size() - 1];
}

// The eigenvalues of the inner J other than the critical ones, by decreasing real part.
class OtherEigenvalues {
 public:
  // kappa: of the critical pair; NaN: a single eigenvalue zero.
  Complex at(const AugmentedEvaluator& curve, double kappa, std::size_t k) {
    to_dense(curve.here().at().jacobian(), J_);
    if (values_.empty() || J_ != of_ || !(kappa == kappa_ || (std::isnan(kappa) && std::isnan(kappa_)))) {
      of_ = J_;
      kappa_ = kappa;
      compute();
    }
    if (k >= values_.size())
      throw std::runtime_error("the eigenvalues of the Jacobian could not be computed");
    return values_[k];
  }

 private:
  void compute() {
    values_.clear();
    if (!solver_.compute(of_)) return;
    values_.assign(solver_.values().begin(), solver_.values().end());
    if (std::isnan(kappa_)) {
      remove_nearest(0);
    } else {
      const Complex root = std::sqrt(Complex(-kappa_));
      remove_nearest(root);
      remove_nearest(-root);
    }
    std::stable_sort(values_.begin(), values_.end(),
                     [](const Complex& x, const Complex& y) { return x.real() > y.real(); });
  }

  void remove_nearest(Complex value) {
    const auto nearest = std::min_element(
        values_.begin(), values_.end(),
        [&](const Complex& x, const Complex& y) { return std::abs(x - value) < std::abs(y - value); });
    if (nearest != values_.end()) values_.erase(nearest);
  }

  Matrix J_, of_;
  double kappa_ = 0;
  Eigenvalues solver_;
  std::vector<Complex> values_;
};

enum class CurveOf { folds, hopf_points };

Complex other_eigenvalue(CurveOf curve, const Accepted& now, std::size_t k) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double kappa = curve == CurveOf::hopf_points ? square_of_frequency(now) : nan;
  return now.scratch.get<OtherEigenvalues>().at(curve_of_points(now), kappa, k);
}

double frequency_of_curve(const Accepted& now) {
  return std::sqrt(std::max(square_of_frequency(now), 0.0));
}

// A monitor of the k-th of the other eigenvalues, which is to be real or one of a pair.
Monitor crossing_monitor(CurveOf curve, std::size_t k, bool of_pair) {
  Monitor monitor;
  monitor.name = curve == CurveOf::hopf_points && of_pair ? "double_hopf" : "zero_hopf";
  monitor.value = [=](const Accepted& now) { return other_eigenvalue(curve, now, k).real(); };
  monitor.is_event = [=](const Accepted& now) {
    if (curve == CurveOf::hopf_points && !(square_of_frequency(now) > 0)) return false;
    const double frequency = other_eigenvalue(curve, now, k).imag();
    return of_pair ? frequency > 0 : frequency == 0;
  };
  monitor.describe = [=](const Accepted& now) -> EventData {
    const double other = other_eigenvalue(curve, now, k).imag();
    const PlaceOnCurve place(now);
    if (curve == CurveOf::folds) return zero_hopf_form(place.at(), place.place(), other);
    if (!of_pair) return zero_hopf_form(place.at(), place.place(), frequency_of_curve(now));
    return double_hopf_form(place.at(), place.place(), frequency_of_curve(now), other);
  };
  return monitor;
}

struct LastLyapunov {
  double value = std::numeric_limits<double>::quiet_NaN();  // l1, which it keeps among neutral saddles
  double least =
      std::numeric_limits<double>::infinity();  // |l1|, or its error, since the last change of sign
};

Coefficient lyapunov_at(const Accepted& now) {
  const PlaceOnCurve place(now);
  return hopf_form_near(place.at(), place.place(), frequency_of_curve(now)).lyapunov;
}

Monitor generalized_hopf_monitor() {
  // l1 changes its sign at its zeros, and at its poles, which are zero-Hopf points.
  constexpr double of_zero = 1e3;  // |l1| over the least one that was seen
  Monitor monitor;
  monitor.name = "generalized_hopf";
  monitor.value = [](const Accepted& now) {
    auto& last = now.scratch.get<LastLyapunov>();
    if (!(square_of_frequency(now) > 0)) return last.value;
    const Coefficient l1 = lyapunov_at(now);
    if (l1.known()) last = {l1.value, std::min(last.least, std::max(std::abs(l1.value), l1.error))};
    return l1.value;
  };
  monitor.is_event = [](const Accepted& now) {
    if (!(square_of_frequency(now) > 0)) return false;
    auto& last = now.scratch.get<LastLyapunov>();
    const bool is_zero = std::abs(lyapunov_at(now).value) <= of_zero * last.least;
    last.least = std::numeric_limits<double>::infinity();
    return is_zero;
  };
  monitor.describe = [](const Accepted& now) -> EventData {
    const PlaceOnCurve place(now);
    return generalized_hopf_form(place.at(), place.place(), frequency_of_curve(now));
  };
  return monitor;
}

// further: unknowns of the curve, besides those of the problem whose J it is.
void check_size_of_spectrum(const Problem& curve, int further) {
  const int unknowns = curve.size() - further;
  if (unknowns > largest_spectrum)
    throw std::invalid_argument("monitors of codimension 2 support at most " +
                                std::to_string(largest_spectrum) + " unknowns, not " +
                                std::to_string(unknowns) + ": all eigenvalues are computed at each point");
}

}  // namespace

std::vector<Monitor> hopf_curve_monitors(const Problem& curve) {
  check_size_of_spectrum(curve, 2);
  std::vector<Monitor> all{zero_frequency_monitor(), generalized_hopf_monitor()};
  for (int k = 0; k < curve.size() - 4; ++k)
    for (const bool of_pair : {false, true})
      all.push_back(crossing_monitor(CurveOf::hopf_points, static_cast<std::size_t>(k), of_pair));
  return all;
}

std::vector<Monitor> fold_curve_monitors(const Problem& curve) {
  check_size_of_spectrum(curve, 1);
  std::vector<Monitor> all{cusp_monitor(), bogdanov_takens_monitor()};
  for (int k = 0; k < curve.size() - 2; ++k)
    all.push_back(crossing_monitor(CurveOf::folds, static_cast<std::size_t>(k), true));
  return all;
}

// The tangent is the null vector of the equations of hopf_points() at frequency 0. Its part along the square
// of the frequency, in scales of the others, is the scale of that.
HopfCurveOrigin hopf_curve_at(const std::shared_ptr<const Problem>& problem, int along,
                              const Event& bogdanov_takens, const Vector& p, int free) {
  const InnerProblem inner(problem, along, {});
  const Eigen::Index n = problem->size();
  if (!std::holds_alternative<BogdanovTakens>(bogdanov_takens.data) ||
      bogdanov_takens.point.u.size() != n + 1)
    throw std::invalid_argument("the event \"" + bogdanov_takens.monitor +
                                "\" is no Bogdanov-Takens point of a curve of folds of this problem");
  if (p.size() != static_cast<Eigen::Index>(problem->parameters().size()) || free < 0 || free >= p.size() ||
      free == along)
    throw std::invalid_argument("the parameters of the curve of Hopf points, " + std::to_string(p.size()) +
                                " with " + std::to_string(free) + " free, are not those of a curve in " +
                                std::to_string(along) + " and another one");
  HopfCurveOrigin origin{nullptr, Vector(n + 2), p, free, {}};
  origin.u << bogdanov_takens.point.u, 0;
  origin.p[free] = bogdanov_takens.point.parameter;
  const auto at = hopf_points(problem, along, 1)->evaluator();
  Matrix equations(n + 2, n + 3);
  Vector by_free(n + 2);
  if (at->move_to(origin.u, origin.p, Needs::jacobian) == Evaluated::ok) {
    at->parameter_derivative(free, by_free);
    equations << std::get<Matrix>(at->jacobian()), by_free;
    origin.tangent = orthogonal_complement(equations.transpose()).col(0);
  }
  if (origin.tangent.size() == 0 || !origin.tangent.allFinite() || origin.tangent[n + 1] == 0)
    throw std::invalid_argument("the curve of Hopf points has no tangent at the Bogdanov-Takens point");
  Vector scales(n + 3);
  scales << inner.scales(), std::numeric_limits<double>::infinity(), inner.parameter(free).change();
  origin.tangent /= std::copysign(origin.tangent.cwiseQuotient(scales).norm(), origin.tangent[n + 1]);
  origin.curve = hopf_points(problem, along, std::sqrt(origin.tangent[n + 1]));
  return origin;
}

}  // namespace arcslip::continuation
