#include <arcslip/continuation/special_points/neighbours.hpp>

#include <cmath>
#include <exception>

namespace arcslip::continuation {

Neighbours::Neighbours(const InnerProblem& inner)
    : inner_(inner),
      scales_(inner.scales()),
      places_{Site(inner), Site(inner)},
      x_(scales_.size()),
      p_(inner.problem->parameters().size()),
      y_(scales_.size()) {}

bool Neighbours::along(const Site& here, In d) {
  const double length = d.cwiseQuotient(scales_).norm();
  if (!(length > 0)) return false;
  const double h = difference_step * std::max(1.0, here.x().cwiseQuotient(scales_).norm()) / length;
  p_ = here.p();
  return take(here, h, [&](double distance) { x_ = here.x() + distance * d; });
}

bool Neighbours::over(const Site& here, int k) {
  const double h = difference_step * std::max(std::abs(here.p()[k]), inner_.parameter(k).change());
  x_ = here.x();
  p_ = here.p();
  return take(here, h, [&](double distance) { p_[k] = here.p()[k] + distance; });
}

template <class PlaceAt>
bool Neighbours::take(const Site& here, double h, PlaceAt&& place) {
  here_ = &here;
  const auto found = difference_within_piece(h, [&](std::size_t i, double distance) {
    place(distance);
    try {
      return places_[i].move_to(x_, p_) == Evaluated::ok && places_[i].at().piece() == here.at().piece();
    } catch (const std::exception&) {  // outside the domain, as it says
      return false;
    }
  });
  if (found) quotient_ = *found;
  return found.has_value();
}

void Neighbours::derivative(In d, Out y) {
  y.setZero();
  sum([&](const Site& place, double weight) {
    place.apply(d, y_.head(y.size()));
    y += weight * y_.head(y.size());
  });
}

bool Neighbours::transposed_derivative(In w, Out dx) {
  bool known = true;
  dx.setZero();
  sum([&](const Site& place, double weight) {
    known = known && place.apply_transposed(w, y_);
    dx += weight * y_;
  });
  return known;
}

double Neighbours::parameter_derivative(In w, int k) {
  double result = 0;
  sum([&](const Site& place, double weight) {
    place.at().parameter_derivative(k, y_.head(w.size()));
    result += weight * w.dot(y_.head(w.size()));
  });
  return result;
}

}  // namespace arcslip::continuation
