#include <arcslip/studies/presentation/figure_parts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace arcslip::studies {
namespace {

using elements::ContactInterval;
using observables::ElementResponse;
using observables::ResponseBranch;
using observables::ResponsePoint;
using results::FigureArea;
using results::Record;

constexpr double turn = 360;

double degrees(double angle) {
  return angle * 180 / std::numbers::pi;
}

// The way from one angle to another, in [-180, 180].
double way(double from, double to) {
  return std::remainder(to - from, turn);
}

// The areas of the states of one contact, point by point. A strip lasts as long as the order of the states is
// the same; where it changes, the strips on both sides meet half-way between the points.
class Areas {
 public:
  void add(double x, const std::vector<ContactInterval>& contact) {
    const std::size_t first = same_order(contact);
    if (first == contact.size()) {
      const double middle = strips_.empty() ? x : 0.5 * (strips_.front().points.back()[0] + x);
      for (Strip& strip : strips_) strip.points.push_back({middle, strip.begin(), strip.end()});
      finish();
      for (const ContactInterval& each : contact)
        strips_.push_back({each.state, {{middle, degrees(each.begin), degrees(each.end)}}});
    }
    for (std::size_t i = 0; i < contact.size(); ++i) {
      const ContactInterval& each = contact[(first + i) % contact.size()];
      const double begin = strips_[i].begin() + way(strips_[i].begin(), degrees(each.begin));
      strips_[i].points.push_back({x, begin, begin + degrees(each.end - each.begin)});
    }
  }

  /// Ends all strips.
  void finish() {
    for (const Strip& strip : strips_) {
      double lowest = strip.begin(), highest = strip.end();
      for (const Record& at : strip.points) {
        lowest = std::min(lowest, at[1]);
        highest = std::max(highest, at[2]);
      }
      for (double shift = -turn * std::floor(highest / turn); lowest + shift < turn; shift += turn)
        put(strip, shift);
    }
    strips_.clear();
  }

  std::vector<FigureArea> take() {
    finish();
    std::vector<FigureArea> all;
    for (const std::string_view kind : results::area_kinds)
      if (const auto found = areas_.find(kind); found != areas_.end())
        all.push_back({std::string(kind), std::move(found->second)});
    return all;
  }

 private:
  struct Strip {
    std::string_view state;
    std::vector<Record> points;  // x, begin, end

    double begin() const { return points.back()[1]; }
    double end() const { return points.back()[2]; }
  };

  // The interval that continues the first strip, where the others follow in order: that at the least
  // distance; else their number.
  std::size_t same_order(const std::vector<ContactInterval>& contact) const {
    std::size_t best = contact.size();
    if (strips_.size() != contact.size()) return best;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t first = 0; first < contact.size(); ++first) {
      double apart = 0;
      for (std::size_t i = 0; i < contact.size(); ++i) {
        const ContactInterval& each = contact[(first + i) % contact.size()];
        apart += each.state == strips_[i].state ? std::abs(way(strips_[i].begin(), degrees(each.begin)))
                                                : std::numeric_limits<double>::infinity();
      }
      if (apart < nearest) nearest = apart, best = first;
    }
    return best;
  }

  // The part of a shifted strip between 0 and 360 degrees.
  void put(const Strip& strip, double shift) {
    std::vector<Record> part;
    bool any = false;
    for (const Record& at : strip.points) {
      const double lower = std::clamp(at[1] + shift, 0.0, turn), upper = std::clamp(at[2] + shift, 0.0, turn);
      any = any || upper > lower;
      part.push_back({at[0], lower, upper});
    }
    if (any) areas_[strip.state].push_back(std::move(part));
  }

  std::vector<Strip> strips_;
  std::map<std::string_view, std::vector<std::vector<Record>>> areas_;
};

bool is_drawn(const ElementResponse& element) {
  return !element.of_patch && !element.contact.empty();
}

std::vector<FigureArea> areas_of(std::span<const ResponseBranch* const> branches, std::size_t element,
                                 const std::function<double(const ResponsePoint&)>& x) {
  Areas areas;
  double reached = -std::numeric_limits<double>::infinity();
  for (const ResponseBranch* branch : branches) {
    for (const ResponsePoint& point : branch->points) {
      if (point.elements.size() <= element || !is_drawn(point.elements[element])) {
        areas.finish();
      } else if (x(point) > reached) {
        reached = x(point);
        areas.add(reached, point.elements[element].contact);
      }
    }
  }
  return areas.take();
}

}  // namespace

std::vector<results::FigureView> contact_figures(std::span<const ResponseBranch* const> branches,
                                                 const std::function<double(const ResponsePoint&)>& x) {
  std::map<std::size_t, std::string> contacts;  // by their index
  for (const ResponseBranch* branch : branches)
    for (const ResponsePoint& point : branch->points)
      for (std::size_t e = 0; e < point.elements.size(); ++e)
        if (is_drawn(point.elements[e])) contacts.emplace(e, point.elements[e].name);
  std::vector<results::FigureView> figures;
  for (const auto& [e, name] : contacts) {
    const bool alone = contacts.size() == 1;
    figures.push_back({.name = alone ? "contact" : "contact_" + name,
                       .y_words = (alone ? "" : name + ": ") + "angle of the period",
                       .areas = areas_of(branches, e, x)});
  }
  return figures;
}

}  // namespace arcslip::studies
