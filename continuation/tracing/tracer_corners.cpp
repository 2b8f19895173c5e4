// Steps across a kink with an arbitrary turn of the branch: section 8.5 of the theory.

#include <arcslip/continuation/tracing/tracer_impl.hpp>

#include <cmath>
#include <iterator>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr int most_corners = 3;  // one after the other

}  // namespace

// If the branch turns by any angle at a kink just ahead: moves to the kink, looks beyond it, and steps along
// the tangent there, oriented by the sign of the determinant. If that step fails, the piece beyond the kink
// may be very short, as where two elements start to slip together: then continues to its end.
bool Tracer::Impl::corner() {
  trial_.begin();
  v_ = s_.here.v + s_.step * s_.here.tangent;
  std::uint64_t ahead = 0;
  if (!main_.move_to(v_) || !main_.piece(ahead) || ahead == s_.here.piece) return false;
  auto& corners = trial_.corners;
  const CurvePoint* from = &s_.here;
  for (int k = 0; k < most_corners; ++k) {
    auto found = events_.corner(*from, s_.step, from->tangent);
    if (!found) return false;
    corners.push_back(std::move(*found));
    if (step_beyond_corner()) return true;
    const std::size_t passed = static_cast<std::size_t>(k) + 1;
    if (corners.size() < passed) return false;  // the branch leaves the window before it
    corners.resize(passed);
    from = &corners.back().beyond;
  }
  return false;
}

// From the last corner along the tangent beyond it.
bool Tracer::Impl::step_beyond_corner() {
  const CurvePoint kink = trial_.corners.back().before;
  const Vector beyond = trial_.corners.back().beyond.tangent;
  const double along = std::abs(beyond[n_]), most = control_.largest_parameter_step();
  const double largest = options_.step.largest_angle;
  CurvePoint& end = trial_.end;
  end.v = kink.v + (along * s_.step > most ? most / along : s_.step) * beyond;
  main_.border_row(beyond, row_);
  trial_.correction = main_.correct(end.v, row_, false);
  if (!trial_.correction.converged || !settle(main_, end)) return false;
  v_ = end.v - kink.v;
  const double length = std::sqrt(main_.dot(v_, v_));
  if (end.piece == s_.here.piece || end.orientation != s_.here.orientation || !(length > 0) ||
      angle_between(main_.dot(end.tangent, beyond)) > largest ||
      angle_between(main_.dot(v_, beyond) / length) > largest)
    return false;
  end.arclength = kink.arclength + length;
  auto more = events_.corners(trial_.corners.back().beyond, end);
  trial_.corners.insert(trial_.corners.end(), std::move_iterator(more.begin()),
                        std::move_iterator(more.end()));
  trial_.length = end.arclength - s_.here.arclength;
  trial_.kink = true;
  if (!measure()) return false;
  interpolation_.measure_curve(trial_);
  if (trial_.curve_error > 1) return false;
  trial_.curve_error = 0;  // the next step is not chosen by it
  divide();
  return interpolation_.resolves_quantities(trial_) && take(s_.step) != Outcome::rejected;
}

}  // namespace arcslip::continuation
