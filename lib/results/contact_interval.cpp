#include <arcslip/results/contact_interval.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcslip::elements {
namespace {

constexpr double least_interval = 1e-12;  // rad: shorter ones are rounding
constexpr double full_turn = 2 * std::numbers::pi;

}  // namespace

void put_in_order(std::vector<ContactInterval>& intervals) {
  std::erase_if(intervals,
                [](const ContactInterval& each) { return !(each.end - each.begin > least_interval); });
  std::size_t count = 0;  // of those that are joined
  for (const ContactInterval& each : intervals) {
    if (count > 0 && intervals[count - 1].state == each.state)
      intervals[count - 1].end = each.end;
    else
      intervals[count++] = each;
  }
  if (count > 1 && intervals[count - 1].state == intervals[0].state)
    intervals[0].begin = intervals[--count].begin - full_turn;
  intervals.resize(count);
  if (count == 1) intervals[0] = {intervals[0].state, 0, full_turn};
  for (ContactInterval& each : intervals) {
    const double shift = full_turn * std::floor(each.begin / full_turn);
    each.begin -= shift;
    each.end -= shift;
  }
  std::sort(intervals.begin(), intervals.end(),
            [](const ContactInterval& a, const ContactInterval& b) { return a.begin < b.begin; });
}

}  // namespace arcslip::elements
