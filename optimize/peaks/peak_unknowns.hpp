#pragma once
// The unknowns of the equations of a peak, for each kind. Not installed.

#include <arcslip/optimize/peaks/peak_amplitude.hpp>

#include <algorithm>

namespace arcslip::optimize {

inline bool is_end(PeakKind kind) {
  return kind == PeakKind::lower_end || kind == PeakKind::upper_end;
}

/// At an end of the window: u.
inline Vector unknowns(const Peak& peak) {
  if (is_end(peak.kind)) return peak.x.head(peak.x.size() - 1);
  return peak.kind == PeakKind::corner ? hbm::with_angles(peak.x, *peak.corner) : peak.x;
}

/// Sets x and the corner of a peak.
inline void set_unknowns(Peak& peak, const Vector& all) {
  const Eigen::Index size = std::min(all.size(), peak.x.size());
  peak.x.head(size) = all.head(size);
  if (peak.kind != PeakKind::corner) return;
  peak.corner = hbm::at_angles(std::move(*peak.corner), all);
}

}  // namespace arcslip::optimize
