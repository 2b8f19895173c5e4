#pragma once
// Status of a computation and the reason why it ended: a constant with a code and an explanation.

#include <ostream>
#include <string_view>

namespace arcslip::results {

/// Why a computation ended. Two reasons are equal if their codes are; an empty code means no reason.
struct Reason {
  std::string_view code{};  // as results write it: "boundary"
  std::string_view help{};  // one line of Markdown

  friend constexpr bool operator==(const Reason& a, const Reason& b) { return a.code == b.code; }
  friend std::ostream& operator<<(std::ostream& to, const Reason& reason) { return to << reason.code; }
};

/// complete: all of the result; stopped: a correct part of it; failed: no result.
enum class Status { complete, stopped, failed };

/// "complete", "stopped" or "failed".
constexpr const char* name(Status status) {
  return status == Status::complete ? "complete" : status == Status::stopped ? "stopped" : "failed";
}

namespace reasons {

inline constexpr Reason user{"user", "the user stopped it; the results so far are kept"};

}  // namespace reasons

}  // namespace arcslip::results
