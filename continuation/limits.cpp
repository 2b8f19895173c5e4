#include <arcslip/continuation/limits.hpp>

#include <arcslip/continuation/text.hpp>

namespace arcslip::continuation {

std::optional<Stop> limit_reached(const Options& options, const Branch& branch, int unknowns, double size,
                                  double parameter, double seconds) {
  if (size > options.largest_state)
    return Stop{StopReason::state_too_large, size, options.largest_state,
                "the solution grows without bound near " + text(parameter)};
  const long points = branch.counts.points;
  if (points >= options.points)
    return Stop{StopReason::point_limit, static_cast<double>(points), static_cast<double>(options.points),
                "reached the largest number of points, " + std::to_string(options.points)};
  if (options.seconds > 0 && seconds >= options.seconds)
    return Stop{StopReason::time_limit, seconds, options.seconds,
                "reached the time limit of " + text(options.seconds) + " s"};
  if (options.memory > 0) {
    const auto numbers = 2 * static_cast<std::size_t>(unknowns) + 1;
    const std::size_t each = sizeof(Point) + (options.keep_points ? sizeof(double) * numbers : 0);
    const std::size_t bytes = each * branch.points.size();
    if (bytes >= options.memory)
      return Stop{StopReason::memory_limit, static_cast<double>(bytes), static_cast<double>(options.memory),
                  "the points of the branch fill the " + std::to_string(options.memory) + " bytes allowed"};
  }
  return {};
}

}  // namespace arcslip::continuation
