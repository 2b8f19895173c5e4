#include <arcslip/report/parts.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace arcslip::report {
namespace {

using Advice = std::pair<std::string_view, std::string_view>;

constexpr const char* in_time_by_balance =
    "Use harmonic balance instead: studies of kind \"frf\" or \"point\" take this scene.";
constexpr const char* other_bounds =
    "Widen the bounds of the parameters, or start the search from another design.";
constexpr const char* other_start =
    "Move the ends of the window away from a resonance, or widen it, so that the start is an easy response.";

/// By the code of the reason.
constexpr std::array advices = {
    Advice{"user", "Run the command again to get all results."},
    Advice{"point_limit", "Choose a shorter range, or divide it among several studies."},
    Advice{"time_limit", "Allow more time, or choose fewer parameters, cases or harmonics."},
    Advice{"memory_limit", "Choose a shorter range or fewer harmonics."},
    Advice{"start_failed", other_start},
    Advice{
        "step_too_small",
        "Look at the end of the curve: where it does not end by itself, more harmonics or a contact with a "
        "lower stiffness help."},
    Advice{"state_too_large", "Add damping, or leave the resonance that grows this far out of the window."},
    Advice{"unbounded",
           "Add damping: at this resonance nothing limits the response. Friction alone does not, where the "
           "force is larger than what it can take."},
    Advice{"not_evaluated", "Check the parameters near this point: a value may be zero or far out of range."},
    Advice{"monitor_failed", "The points are right. Events of this kind may be missing."},
    Advice{"event", "Follow the curve from its other side, or over a range that begins beyond this point."},
    Advice{"boundary", "Widen the window or the range in the direction in which the curve leaves it."},
    Advice{"branch_point", "Ask for the other branches with \"branches\": \"all\"."},
    Advice{"no_mode", "Choose a mode that moves the response; arcslip check lists the natural frequencies."},
    Advice{"not_piecewise_linear", "Use the method \"newmark\", or harmonic balance."},
    Advice{"massless", "Give each degree of freedom a mass, or use harmonic balance."},
    Advice{"set_valued", "Give the friction a contact stiffness, or use harmonic balance."},
    Advice{"loss_factor", in_time_by_balance},
    Advice{"sector", in_time_by_balance},
    Advice{"several_places", "Choose one place as the response of this study."},
    Advice{"period_limit",
           "Allow more periods, or use the method \"event-driven\" or \"shooting\". A motion that is not "
           "periodic never settles: look at its history."},
    Advice{"no_periodic_motion",
           "Start from a nearer motion, or look at the history of a transient: the motion may not be "
           "periodic."},
    Advice{"no_convergence", "Use more steps per period."},
    Advice{"singular",
           "Give each degree of freedom without a mass a spring or a damper in addition to its contacts."},
    Advice{"not_finite", "Use more steps per period, or check whether the scene has negative damping."},
    Advice{"event_limit", "Use the method \"newmark\", or fewer periods."},
    Advice{"energy_defect", "Use more steps per period."},
    // Searches for an optimum, and curves of optima.
    Advice{"evaluation_limit", "Allow more evaluations, or choose narrower bounds."},
    Advice{"infeasible", "Relax the constraint that is violated, or widen the bounds."},
    Advice{"other_peak", "Widen the window so that it has all peaks that may become the highest."},
    Advice{"end_of_window", "Choose the window that the message gives."},
    Advice{"scatter_limit", "Choose narrower ranges of the uncertain parameters."},
    Advice{"lower_beside", other_bounds},
    Advice{"not_stationary", other_bounds},
    Advice{"no_response", other_start},
    Advice{"objective_failed", "Check the scene at the design that the message names."},
    Advice{"invalid_arguments", "Choose another algorithm."},
    Advice{"out_of_memory", "Choose another algorithm, or fewer parameters."},
    Advice{"failed", "Choose another algorithm."},
    Advice{"flat",
           "Choose bounds within which the parameters matter: outside, the contact only sticks or only "
           "slips."},
    Advice{"rounding", other_bounds},
    Advice{"turned_back", "Begin the curve at the other end of its range."},
    Advice{"lost_peak", "Search for the optimum beyond this point, and begin a curve there."},
    Advice{"no_exchange", "Search for the optimum beyond this point, and begin a curve there."},
    Advice{"no_progress", "Search for the optimum beyond this point, and begin a curve there."},
};

}  // namespace

std::string_view advice(std::string_view reason) {
  const auto* const found =
      std::find_if(advices.begin(), advices.end(), [&](const Advice& each) { return each.first == reason; });
  return found == advices.end() ? std::string_view() : found->second;
}

}  // namespace arcslip::report
