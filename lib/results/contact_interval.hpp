#pragma once
// What a contact does over the period, as intervals.

#include <string_view>
#include <vector>

namespace arcslip::elements {

/// rad: slip so short before separation, as where the bound and the slider meet just there, would come and go
/// by rounding.
inline constexpr double negligible_slip = 1e-9;

/// state: the name of a mode in time (laws/automaton.hpp), a literal: "stick"; "slip+" and "slip-", by the
/// sign of the friction force, and "slip" where it has several directions; "open", "closed"; "closed+" and
/// "closed-" where a spring has one contact at each side.
struct ContactInterval {
  std::string_view state;
  double begin = 0, end = 0;  // rad
  friend bool operator==(const ContactInterval&, const ContactInterval&) = default;
};

/// Of intervals that follow each other over one period: without empty ones, with neighbours of one state
/// joined, and by their beginnings, in [0, 2 pi), ascending. One alone begins at 0.
void put_in_order(std::vector<ContactInterval>& intervals);

}  // namespace arcslip::elements
