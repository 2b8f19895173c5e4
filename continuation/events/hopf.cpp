#include <arcslip/continuation/events/hopf.hpp>

#include <arcslip/continuation/events/hopf_refinement.hpp>
#include <arcslip/continuation/events/place_of_event.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/linear/shifted_solver.hpp>
#include <arcslip/continuation/normal_forms/hopf_form.hpp>
#include <arcslip/continuation/stability/spectrum_finder.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr const char* not_computed = "the eigenvalues of the Jacobian could not be computed";

constexpr double same_crossing = 1e-8;   // real parts, of the largest eigenvalue: pairs that cross together
constexpr double same_frequency = 1e-4;  // of pairs that cross together: their vectors are not separate

Hopf described(double frequency, const Eigen::VectorXcd& vector, const Vector& scales) {
  Eigen::VectorXcd z = vector.cwiseQuotient(scales.cast<std::complex<double>>());
  z /= z.norm();
  // By the phase that makes sum z_i^2 = |a|^2 - |b|^2 + 2i a . b real and not negative.
  z *= std::polar(1.0, -0.5 * std::arg(z.cwiseProduct(z).sum()));
  Eigen::Index largest;
  z.real().cwiseAbs().maxCoeff(&largest);
  if (z[largest].real() < 0) z = -z;
  Hopf hopf;
  hopf.frequency = frequency;
  hopf.real = z.real().cwiseProduct(scales);
  hopf.imaginary = z.imag().cwiseProduct(scales);
  return hopf;
}

std::optional<RefinedEvent> refined_hopf(const Accepted& now, double frequency, const Eigen::VectorXcd& z,
                                         const Vector& scales, const HopfOptions& options) {
  const auto better = refine_hopf(now, frequency, z, scales);
  if (!better) return {};
  Hopf data = described(better->frequency, better->z, scales);
  PlaceOfForms place = place_of_event(now);
  place.u = better->x.head(now.u.size());
  place.p[now.free] = better->x[now.u.size()];
  if (options.normal_form) add_normal_form(now.at, place, data);
  return RefinedEvent{better->x, std::move(data)};
}

// The eigenvalues of J by decreasing real part, shared by all monitors at one point: recomputed if J changed.
class SortedEigenvalues {
 public:
  std::complex<double> eigenvalue(const Jacobian& jacobian, std::size_t k) {
    compute(jacobian);
    return eigenvalues_[k];
  }

  // Of the k-th eigenvalue, on the imaginary axis to rounding. The order of pairs that cross together depends
  // on rounding: they are sorted by frequency, lowest first.
  EventData hopf(const Accepted& now, std::size_t k, const Vector& scales, const HopfOptions& options) {
    const auto found = crossing(now.at.jacobian(), k);
    if (!found) return {};
    Hopf data = described(found->frequency, found->z, scales);
    if (options.normal_form && found->separate) add_normal_form(now.at, place_of_event(now), data);
    return data;
  }

  // The same by its own equations, unless pairs of one frequency cross together.
  std::optional<RefinedEvent> refined(const Accepted& now, std::size_t k, const Vector& scales,
                                      const HopfOptions& options) {
    const auto found = crossing(now.at.jacobian(), k);
    if (!found || !found->separate) return {};
    return refined_hopf(now, found->frequency, found->z, scales, options);
  }

 private:
  void compute(const Jacobian& jacobian) {
    to_dense(jacobian, J_);
    if (!eigenvalues_.empty() && J_ == at_) return;
    at_ = J_;
    if (!solver_.compute(at_)) throw std::runtime_error(not_computed);
    const auto& all = solver_.values();
    eigenvalues_.assign(all.begin(), all.end());
    std::stable_sort(eigenvalues_.begin(), eigenvalues_.end(),
                     [](const auto& x, const auto& y) { return x.real() > y.real(); });
  }

  struct CrossingPair {
    double frequency;
    Eigen::VectorXcd z;
    bool separate;  // no other pair of its frequency crosses with it
  };

  std::optional<CrossingPair> crossing(const Jacobian& jacobian, std::size_t k) {
    compute(jacobian);
    double largest = 0;
    for (const auto& each : eigenvalues_) largest = std::max(largest, std::abs(each));
    std::size_t rank = 0, count = 0;
    for (std::size_t i = 0; i < eigenvalues_.size(); ++i) {
      const auto each = eigenvalues_[i];
      if (!(each.imag() > 0) || std::abs(each.real() - eigenvalues_[k].real()) > same_crossing * largest)
        continue;
      if (i < k) ++rank;
      ++count;
    }
    if (rank >= count) return {};
    const Modes modes = continuation::modes(J_);
    const auto& all = modes.values;
    // The pairs nearest to the axis, as many as cross together, in the order of their frequencies.
    std::vector<Eigen::Index> pairs;
    for (Eigen::Index i = 0; i < all.size(); ++i)
      if (all[i].imag() > 0) pairs.push_back(i);
    if (pairs.size() < count) return {};
    std::stable_sort(pairs.begin(), pairs.end(), [&](Eigen::Index i, Eigen::Index j) {
      return std::abs(all[i].real()) < std::abs(all[j].real());
    });
    pairs.resize(count);
    std::stable_sort(pairs.begin(), pairs.end(),
                     [&](Eigen::Index i, Eigen::Index j) { return all[i].imag() < all[j].imag(); });
    const double frequency = all[pairs[rank]].imag();
    const auto equal = std::count_if(pairs.begin(), pairs.end(), [&](Eigen::Index i) {
      return std::abs(all[i].imag() - frequency) <= same_frequency * frequency;
    });
    return CrossingPair{frequency, modes.V.col(pairs[rank]), equal == 1};
  }

  Matrix J_, at_;
  Eigenvalues solver_;
  std::vector<std::complex<double>> eigenvalues_;
};

constexpr double on_the_axis =
    1e-5;                       // |Re mu| of |mu|, at an event: more, and a pair has appeared, or is lost
constexpr double no_pair = -1;  // value of a monitor without a pair
constexpr int many_eigenvalues = 1 << 20;  // all that were found

// Pairs next to the imaginary axis, by decreasing real part, of a large J: recomputed if J changed.
class FoundPairs {
 public:
  std::complex<double> pair(const Jacobian& jacobian, std::size_t k, const HopfOptions& options) {
    const auto& J = std::get<SparseMatrix>(jacobian);
    if (!finder_) {
      StabilityOptions all = options.spectrum;
      all.leading = many_eigenvalues;
      finder_.emplace(std::move(all));
    }
    const Eigen::Map<const Vector> values(J.valuePtr(), J.nonZeros());
    if (at_.size() != values.size() || at_ != values) {
      at_ = values;
      pairs_.clear();
      for (const auto& each : finder_->at(jacobian).leading)
        if (each.imag() > 0) pairs_.push_back(each);
    }
    return k < pairs_.size() ? pairs_[k] : std::complex<double>(no_pair, 0);
  }

 private:
  std::optional<SpectrumFinder> finder_;
  Vector at_;
  std::vector<std::complex<double>> pairs_;
};

std::optional<RefinedEvent> refined_found_pair(const Accepted& now, std::complex<double> mu,
                                               const Vector& scales, const HopfOptions& options) {
  ShiftedSolver solver(now.at.jacobian());
  ComplexVector generic(now.u.size());
  for (Eigen::Index i = 0; i < generic.size(); ++i)
    generic[i] = std::polar(scales[i], static_cast<double>(i * i));
  const auto near = refined_eigenpair(solver, mu, generic);
  if (!near) return {};
  return refined_hopf(now, near->value.imag(), near->right, scales, options);
}

std::vector<Monitor> monitors_of_found_pairs(const Vector& scales, const HopfOptions& options) {
  if (options.pairs < 1)
    throw std::invalid_argument("the number of pairs to watch for Hopf points is " +
                                std::to_string(options.pairs) + ", must be >= 1");
  std::vector<Monitor> monitors(static_cast<std::size_t>(options.pairs));
  for (std::size_t k = 0; k < monitors.size(); ++k) {
    const auto pair = [=](const Accepted& now) {
      return now.scratch.get<FoundPairs>().pair(now.at.jacobian(), k, options);
    };
    monitors[k].name = "hopf";
    monitors[k].value = [=](const Accepted& now) { return pair(now).real(); };
    monitors[k].is_event = [=](const Accepted& now) {
      return pair(now).imag() > 0 && std::abs(pair(now).real()) <= on_the_axis * std::abs(pair(now));
    };
    monitors[k].refine = [=](const Accepted& now) {
      return refined_found_pair(now, pair(now), scales, options);
    };
  }
  return monitors;
}

}  // namespace

void to_dense(const Jacobian& J, Matrix& dense) {
  if (const auto* full = std::get_if<Matrix>(&J))
    dense = *full;
  else if (const auto* sparse = std::get_if<SparseMatrix>(&J))
    dense = *sparse;
  else
    throw std::invalid_argument(
        "the Jacobian is an operator, whose eigenvalues cannot be computed: Hopf points require a dense or "
        "sparse Jacobian");
}

std::vector<Monitor> hopf_monitors(const Problem& problem, const HopfOptions& options) {
  const int n = problem.size();
  const Vector scales = problem.scales();
  check(options.spectrum, n);
  if (options.spectrum.mass)
    throw std::invalid_argument(
        "Hopf points are those of u' = F: they are not located with a mass matrix; multiply F by its "
        "inverse, "
        "or ask for the spectrum of points (Options::stability)");
  if (n > largest_spectrum) {
    if (!std::holds_alternative<SparseMatrix>(problem.evaluator()->jacobian()))
      throw std::invalid_argument("Hopf points of " + std::to_string(n) + " unknowns, more than " +
                                  std::to_string(largest_spectrum) + ", require a sparse Jacobian");
    return monitors_of_found_pairs(scales, options);
  }
  std::vector<Monitor> monitors(static_cast<std::size_t>(n));
  for (std::size_t k = 0; k < monitors.size(); ++k) {
    const auto eigenvalue = [k](const Accepted& now) {
      return now.scratch.get<SortedEigenvalues>().eigenvalue(now.at.jacobian(), k);
    };
    monitors[k].name = "hopf";
    monitors[k].value = [=](const Accepted& now) { return eigenvalue(now).real(); };
    monitors[k].is_event = [=](const Accepted& now) { return eigenvalue(now).imag() > 0; };  // once a pair
    monitors[k].refine = [=](const Accepted& now) {
      return now.scratch.get<SortedEigenvalues>().refined(now, k, scales, options);
    };
    monitors[k].describe = [=](const Accepted& now) {
      return now.scratch.get<SortedEigenvalues>().hopf(now, k, scales, options);
    };
  }
  return monitors;
}

NearbyCycle cycle_near(const Event& event, double amplitude) {
  const auto* hopf = std::get_if<Hopf>(&event.data);
  if (!hopf) throw std::invalid_argument("the event \"" + event.monitor + "\" has no data of a Hopf point");
  if (!(amplitude > 0 && std::isfinite(amplitude)))
    throw std::invalid_argument("the amplitude of a cycle is " + std::to_string(amplitude) +
                                ", must be positive");
  if (!std::isfinite(hopf->parameter_shift) || hopf->mean.size() == 0)
    throw std::invalid_argument("the normal form of the Hopf point at " +
                                std::to_string(event.point.parameter) +
                                " is not known, and neither are the cycles near it");
  const double square = amplitude * amplitude, length = std::hypot(hopf->real.norm(), hopf->imaginary.norm());
  NearbyCycle cycle;
  cycle.parameter = event.point.parameter + square * hopf->parameter_shift;
  cycle.frequency = hopf->frequency + square * hopf->frequency_shift;
  cycle.mean = event.point.u + square * hopf->mean;
  cycle.harmonics.resize(hopf->real.size(), 4);
  cycle.harmonics << 2 * amplitude / length * hopf->real, -2 * amplitude / length * hopf->imaginary,
      square * hopf->second_real, -square * hopf->second_imaginary;
  return cycle;
}

Vector NearbyCycle::at(double theta) const {
  return mean + harmonics * Eigen::Vector4d(std::cos(theta), std::sin(theta), std::cos(2 * theta),
                                            std::sin(2 * theta));
}

}  // namespace arcslip::continuation
