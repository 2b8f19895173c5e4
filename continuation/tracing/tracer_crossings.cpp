// Branch points in a step of the tracer: section 8.10 of the theory.

#include <arcslip/continuation/special_points/lyapunov_schmidt.hpp>
#include <arcslip/continuation/special_points/multiple_point.hpp>
#include <arcslip/continuation/tracing/tracer_impl.hpp>

#include <algorithm>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double branch_point_step = 1e-7;  // relative to 1 + |u|: shorter steps cannot separate two branches
constexpr double pair_share = 1e-3;  // of the first step in which a mode may cross zero and return: minimum

// If pieces of F meet there, or the branch point is not simple.
LocatedEvent unlocated_branch_point(const std::vector<Monitor>& monitors, const CurvePoint& from,
                                    const CurvePoint& to) {
  LocatedEvent found;
  for (const Monitor& monitor : monitors)
    if (monitor.kind == MonitorKind::branch_point) found.event.monitor = monitor.name;
  found.event.nonsmooth = from.piece != to.piece;
  found.event.located = found.event.nonsmooth;
  found.event.point = point(from, {});
  BranchPoint half_branches;
  half_branches.tangents = {from.tangent, to.tangent};
  found.event.data = std::move(half_branches);
  found.place = from;
  return found;
}

}  // namespace

// Locates the branch point in the step, if any, and rejects the step otherwise: a change of orientation is a
// jump to a nearby branch, unless branches cross here or it persists with the smallest step; and several
// modes that cross zero are several branch points, unless they do so at the same point.
std::optional<Tracer::Impl::Outcome> Tracer::Impl::look_for_crossing() {
  const double inseparable = branch_point_step * (1 + main_.norm_u(s_.here.v));
  const bool apart = s_.step > inseparable;
  const auto crossed = counts_modes_ ? count_modes() : std::nullopt;
  if (crossed && crossed->at_zero && apart) return refuse(Rejected::branch_points, 1, 0, Outcome::unresolved);
  const bool turned = changes_determinant(crossed);
  const int modes = crossed && crossed->is_odd() == turned ? crossed->count : turned ? 1 : 0;
  if (crossed && modes == 0 && !crossed->is_certain && !interpolation_.stretch_is_short(pair_share)) {
    interpolation_.begin_stretch(trial_.length);
    return refuse(Rejected::branch_points, 2, 1, Outcome::unresolved);
  }
  if (modes == 0 || locate_crossing(modes)) return {};
  if (apart && turned) return refuse(Rejected::another_branch, 0, 0);
  if (apart) return refuse(Rejected::branch_points, modes, 1, Outcome::unresolved);
  return pass_unlocated_crossing(inseparable);
}

// Finds the branch point at which so many modes cross zero. The sign of the determinant alone says that an
// odd number does.
bool Tracer::Impl::locate_crossing(int modes) {
  trial_.end.arclength = s_.here.arclength + trial_.length;
  auto& crossing = trial_.crossing;
  if (modes == 1) crossing = events_.branch_point(s_.here, trial_.end);
  for (int loss = std::max(modes, 2); counts_modes_ && !crossing && loss <= largest_rank_loss; ++loss)
    if (loss == modes || modes == 1) crossing = events_.multiple_point(s_.here, trial_.end, loss);
  return crossing.has_value();
}

// Of the smallest step: the branch ends where solutions are not isolated, and otherwise passes a branch point
// that was not located.
std::optional<Tracer::Impl::Outcome> Tracer::Impl::pass_unlocated_crossing(double smallest) {
  const CurvePoint& to = trial_.end;
  const std::string doubt = doubt_of_isolation(*problem_, s_.here.v, s_.p, s_.free, options_.linear_solver);
  if (!doubt.empty() && to.piece == s_.here.piece) {
    end(StopReason::step_too_small, s_.step, smallest,
        "the orientation of the branch changes even with the smallest step" + doubt);
    return Outcome::ended;
  }
  trial_.crossing = unlocated_branch_point(monitors_, s_.here, to);
  return {};
}

// The modes that cross zero in the step, on one smooth piece.
std::optional<ModeCrossings> Tracer::Impl::count_modes() {
  if (trial_.end.piece != s_.here.piece) return {};
  if (!modes_) modes_ = std::make_unique<ModeCounter>(*problem_, s_.p, s_.free, s_.branch.counts);
  return modes_->between(s_.here, trial_.end, trial_.length, row_, main_.factors());
}

// Whether the sign of the determinant changes in the step. A linear solver that does not know it leaves that
// to the modes that cross zero, where these are counted, and to the determinant of a few more borders; where
// pieces meet, it is not known.
bool Tracer::Impl::changes_determinant(const std::optional<ModeCrossings>& crossed) {
  const CurvePoint& to = trial_.end;
  if (to.orientation != 0 && s_.here.orientation != 0) return to.orientation != s_.here.orientation;
  if (to.piece != s_.here.piece) return false;
  const TransverseSpace::Sign sign = transverse_.compare(trial_);
  if (crossed && (crossed->count > 0 || modes_->counts_all())) return crossed->is_odd();
  if (sign != TransverseSpace::Sign::open) return sign == TransverseSpace::Sign::changed;
  const auto counted = crossed ? crossed : count_modes();
  return counted && counted->is_odd();
}

}  // namespace arcslip::continuation
