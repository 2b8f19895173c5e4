#pragma once
// How a computation ended, and why, as a constant that has a code and an explanation.

#include <ostream>
#include <string_view>

namespace arcslip::results {

/// Why a computation ended: a constant, equal to another where their codes are. Without a code: none.
struct Reason {
  std::string_view code{};  // as results write it: "boundary"
  std::string_view help{};  // one line of Markdown

  friend constexpr bool operator==(const Reason& a, const Reason& b) { return a.code == b.code; }
  friend std::ostream& operator<<(std::ostream& to, const Reason& reason) { return to << reason.code; }
};

/// How it ended: with all that was asked for, right as far as it goes, or without what was asked for.
enum class Status { complete, stopped, failed };

/// "complete", "stopped" or "failed".
constexpr const char* name(Status status) {
  return status == Status::complete ? "complete" : status == Status::stopped ? "stopped" : "failed";
}

namespace reasons {

inline constexpr Reason user{"user", "the user stopped it; what was computed until then is kept"};

}  // namespace reasons

}  // namespace arcslip::results
