// Steps across a kink at which the branch turns by any angle.

#include <arcslip/continuation/tracer.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::continuation {
namespace {

// Beyond a kink, of the step, to linearize there: the longer one, unless another piece lies between.
constexpr double corner_step = 1e-3, nearest_step = 1e-6;

}  // namespace

// Where the branch turns by any angle at a kink just ahead: goes to the kink, linearizes beyond it, and steps
// along the tangent there, whose direction the sign of the determinant tells.
bool Tracer::corner() {
  crossing_.reset();
  curve_error_ = 0;
  v_ = s_.here.v + s_.step * s_.here.tangent;
  std::uint64_t ahead = 0;
  if (!main_->move_to(v_) || !main_->piece(ahead) || ahead == s_.here.piece) return false;
  Place kink;
  Correction correction;
  if (!locate_kink(*main_, s_.here, s_.step, kink, correction)) return false;
  Corner sides;
  const double way = kink.arclength - s_.here.arclength;
  bool has_sides = look_beside(kink, kink.tangent, -corner_step * way, sides.before) &&
                   sides.before.piece == s_.here.piece;
  sides.before.v = kink.v;
  sides.before.arclength = kink.arclength;
  curve_error_ = 0;
  if (has_sides && !resolved(s_.here, sides.before, way)) return false;
  const double share = beyond_share(kink, s_.here.tangent);
  next_.v = kink.v + share * s_.step * s_.here.tangent;
  main_->border_row(s_.here.tangent, row_);
  if (!main_->linearize(next_.v, row_) ||
      !settle(*main_, next_)) {  // at a right angle, a row that is neither
    row_.setZero();
    row_[n_] = 1;
    if (!main_->linearize(next_.v, row_) || !settle(*main_, next_)) return false;
  }
  if (next_.piece == s_.here.piece) return false;
  if (next_.orientation != s_.here.orientation) next_.tangent = -next_.tangent;
  const Vector beyond = next_.tangent;
  const double way_beyond = std::min(share, beyond_share(kink, beyond)) * s_.step;
  next_.v = kink.v + s_.step * beyond;
  main_->border_row(beyond, row_);
  correction = main_->correct(next_.v, row_, false);
  if (!correction.converged || !settle(*main_, next_)) return false;
  v_ = next_.v - kink.v;
  const double length = std::sqrt(main_->dot(v_, v_));
  if (next_.piece == s_.here.piece || next_.orientation != s_.here.orientation || !(length > 0) ||
      angle_between(main_->dot(next_.tangent, beyond)) > options_.step.largest_angle ||
      angle_between(main_->dot(v_, beyond) / length) > options_.step.largest_angle)
    return false;
  if (!measure(next_)) return false;
  has_sides =
      has_sides && look_beside(kink, beyond, way_beyond, sides.beyond) && sides.beyond.piece != s_.here.piece;
  if (has_sides && !resolved(sides.beyond, next_, length)) return false;
  return take(way + length, s_.step, true, correction, has_sides ? &sides : nullptr) != Attempt::rejected;
}

// How far beyond a kink the piece is still that next to it.
double Tracer::beyond_share(const Place& kink, const Vector& way) {
  std::uint64_t near = kink.piece, far = kink.piece;
  v_ = kink.v + nearest_step * s_.step * way;
  const bool known = main_->move_to(v_) && main_->piece(near);
  v_ = kink.v + corner_step * s_.step * way;
  if (!known || !main_->move_to(v_) || !main_->piece(far)) return corner_step;
  return near == far || near == kink.piece ? corner_step : nearest_step;
}

// A place shortly before (way < 0) or beyond a kink, on the branch, with its monitors.
bool Tracer::look_beside(const Place& kink, const Vector& tangent, double way, Place& side) {
  side.v = kink.v + way * tangent;
  side.tangent = tangent;
  side.arclength = kink.arclength + way;
  main_->border_row(tangent, v_);
  if (!main_->correct(side.v, v_, false).converged || !main_->linearize(side.v, v_) || !settle(*main_, side))
    return false;
  evaluate(monitors_, *main_, side);
  return true;
}

}  // namespace arcslip::continuation
