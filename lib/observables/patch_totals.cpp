#include <arcslip/observables/patch_totals.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace arcslip::observables {
namespace {

// The total normal load of a patch over the period.
class TotalLoad {
 public:
  TotalLoad(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, elements::In p,
            const model::Patch& patch)
      : h_(problem.harmonics()), phi_(h_.size()) {
    const auto count = static_cast<Eigen::Index>(patch.areas.size());
    motions_.resize(count, h_.size());
    x_.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const std::size_t e = patch.first + static_cast<std::size_t>(i);
      const auto& element = problem.model().elements[e];
      const Eigen::Index normal = (element.law->directions() - 1) * h_.size();
      motions_.row(i) = at.element_motion(e).segment(normal, h_.size()).transpose();
      contacts_.push_back({element.law.get(), element.fields(p)});
    }
  }

  double at(double theta) {
    elements::series_basis(h_, theta, phi_);
    x_.noalias() = motions_ * phi_;
    double sum = 0;
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      sum += contacts_[i].law->normal_load_at(contacts_[i].fields, x_[static_cast<Eigen::Index>(i)]);
    return sum;
  }

  std::pair<double, double> extremes() {
    const int count = std::max(64, 8 * (h_.order + 1));
    const double step = 2 * std::numbers::pi / count;
    double lowest = at(0), highest = lowest;
    int least = 0, most = 0;
    for (int k = 1; k < count; ++k) {
      const double load = at(k * step);
      if (load < lowest) lowest = load, least = k;
      if (load > highest) highest = load, most = k;
    }
    return {std::min(lowest, -refined(-1, (least - 1) * step, (least + 1) * step)),
            std::max(highest, refined(1, (most - 1) * step, (most + 1) * step))};
  }

 private:
  struct Contact {
    const elements::Law* law;
    std::vector<double> fields;
  };

  // The largest sign * load in [a, b], by golden sections.
  double refined(double sign, double a, double b) {
    constexpr int sections = 44;  // to the square root of rounding, of one part in 64
    const double g = std::numbers::phi - 1;
    double left = b - g * (b - a), right = a + g * (b - a);
    double at_left = sign * at(left), at_right = sign * at(right);
    for (int k = 0; k < sections; ++k) {
      if (at_left > at_right) {
        b = right, right = left, at_right = at_left;
        left = b - g * (b - a), at_left = sign * at(left);
      } else {
        a = left, left = right, at_left = at_right;
        right = a + g * (b - a), at_right = sign * at(right);
      }
    }
    return std::max(at_left, at_right);
  }

  elements::Harmonics h_;
  Eigen::MatrixXd motions_;  // contacts x coefficients
  Eigen::VectorXd phi_, x_;
  std::vector<Contact> contacts_;
};

}  // namespace

void add_patches(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, elements::In p,
                 ResponsePoint& point) {
  for (const model::Patch& patch : problem.model().patches) {
    const std::span elements(point.elements.data() + patch.first, patch.areas.size());
    for (ElementResponse& element : elements) element.of_patch = true;
    ElementResponse& sum = point.patches.emplace_back(total<ElementResponse>(patch, elements));
    sum.has_stick = elements.front().has_stick;
    if (sum.has_normal_load)
      std::tie(sum.normal_load_min, sum.normal_load_max) = TotalLoad(problem, at, p, patch).extremes();
  }
}

}  // namespace arcslip::observables
