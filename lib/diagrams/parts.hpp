#pragma once
// What results and figures of branches and diagrams share.

#include <arcslip/continuation/diagrams/diagram.hpp>
#include <arcslip/diagrams/output.hpp>
#include <arcslip/results/event_kind.hpp>

#include <string>
#include <vector>

namespace arcslip::diagrams {

/// A branch as all three sources have it.
struct BranchPart {
  const continuation::Branch* branch;
  const continuation::BranchStop* begin = nullptr;  // null: traced from its start on
  std::vector<continuation::StabilityRange> stability{};
  int depth = 0, origin = -1;         // of a diagram
  std::vector<std::string> labels{};  // of its events
};

/// Labels are the words of an event's kind, or the name of one's own monitor, with a number where there are
/// several of them: "fold 1", "fold 2", "Hopf point". They are counted over all branches. A branch point of a
/// diagram has its number in the list of branch points on each branch that it is on.
std::vector<BranchPart> parts_of(const continuation::Branch& branch);
std::vector<BranchPart> parts_of(const continuation::WholeBranch& branch);
std::vector<BranchPart> parts_of(const continuation::Diagram& diagram);

/// The kind of an event: by its data, and of those without any by the monitor's name.
const results::EventKind& kind_of(const continuation::Event& event);

}  // namespace arcslip::diagrams
