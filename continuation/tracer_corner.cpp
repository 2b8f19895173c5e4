// Steps across a kink at which the branch turns by any angle.

#include <arcslip/continuation/tracer.hpp>

#include <cmath>
#include <iterator>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr int most_corners = 3;  // one after the other

}  // namespace

// Where the branch turns by any angle at a kink just ahead: goes to the kink, looks beyond it, and steps
// along the tangent there, whose direction the sign of the determinant tells. Where that step fails, the
// piece beyond the kink may end at once, as where two elements begin to slip together: then on to its end.
bool Tracer::corner() {
  crossing_.reset();
  corners_.clear();
  curve_error_ = 0;
  v_ = s_.here.v + s_.step * s_.here.tangent;
  std::uint64_t ahead = 0;
  if (!main_->move_to(v_) || !main_->piece(ahead) || ahead == s_.here.piece) return false;
  const Place* from = &s_.here;
  for (int k = 0; k < most_corners; ++k) {
    auto found = events_->corner(*from, s_.step, from->tangent);
    if (!found) return false;
    corners_.push_back(std::move(*found));
    if (step_beyond_corner()) return true;
    corners_.resize(static_cast<std::size_t>(k) + 1);
    from = &corners_.back().beyond;
  }
  return false;
}

// From the last corner along the tangent beyond it.
bool Tracer::step_beyond_corner() {
  const Place kink = corners_.back().before;
  const Vector beyond = corners_.back().beyond.tangent;
  const double along = std::abs(beyond[n_]), most = largest_parameter_step();
  next_.v = kink.v + (along * s_.step > most ? most / along : s_.step) * beyond;
  main_->border_row(beyond, row_);
  const Correction correction = main_->correct(next_.v, row_, false);
  if (!correction.converged || !settle(*main_, next_)) return false;
  v_ = next_.v - kink.v;
  const double length = std::sqrt(main_->dot(v_, v_));
  if (next_.piece == s_.here.piece || next_.orientation != s_.here.orientation || !(length > 0) ||
      angle_between(main_->dot(next_.tangent, beyond)) > options_.step.largest_angle ||
      angle_between(main_->dot(v_, beyond) / length) > options_.step.largest_angle)
    return false;
  next_.arclength = kink.arclength + length;
  auto more = events_->corners(corners_.back().beyond, next_);
  corners_.insert(corners_.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
  const double whole = next_.arclength - s_.here.arclength;
  if (!measure(next_) || curve_error() > 1) return false;
  divide();
  return resolved(whole) && take(whole, s_.step, true, correction) != Attempt::rejected;
}

}  // namespace arcslip::continuation
