#pragma once
// The unknowns of the equations of a peak, by its kind. Not installed.

#include <arcslip/optimize/peak_amplitude.hpp>

#include <algorithm>

namespace arcslip::optimize {

inline bool is_end(PeakKind kind) {
  return kind == PeakKind::lower_end || kind == PeakKind::upper_end;
}

/// u and omega, and at a corner the angles of its reversals: the unknowns of slip_corner_points().
inline Vector with_angles(const Vector& x, const hbm::SlipCorner& corner) {
  Vector all(x.size() + 2);
  all << x, corner.anchor, corner.reversal;
  return all;
}

/// At an end of the window: u.
inline Vector unknowns(const Peak& peak) {
  if (is_end(peak.kind)) return peak.x.head(peak.x.size() - 1);
  return peak.kind == PeakKind::corner ? with_angles(peak.x, *peak.corner) : peak.x;
}

/// x of a peak, and its corner.
inline void set_unknowns(Peak& peak, const Vector& all) {
  const Eigen::Index size = std::min(all.size(), peak.x.size());
  peak.x.head(size) = all.head(size);
  if (peak.kind != PeakKind::corner) return;
  peak.corner->anchor = all[size];
  peak.corner->reversal = all[size + 1];
}

}  // namespace arcslip::optimize
