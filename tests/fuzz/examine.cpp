#include "fuzz/examine.hpp"
#include "environment.hpp"

#include "catalogue.hpp"
#include "controls.hpp"
#include "csv_text.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/modes_and_time/accuracy.hpp>
#include <arcslip/analyses/modes_and_time/frequency_sweep.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/results/csv_writer.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/presentation/branches.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <numbers>
#include <sstream>
#include <string_view>
#include <typeinfo>
#include <utility>

namespace fuzz {
namespace {

using namespace arcslip;
using nlohmann::json;

constexpr int most_points = 30, most_combinations = 4, highest_order = 5, most_samples = 128;
constexpr std::size_t most_dofs = 8, most_elements = 8;

// Of the files that scenes name.
const std::string folder = source_folder() + "/tests/fuzz/corpus";

// What an engineer has never heard of.
constexpr std::string_view internal_words[] = {"step.",      "options.", "std::",    "basic_string",
                                               "json.excep", "vector::", "Eigen",    "_M_",
                                               "nullptr",    "iterator", "callback", "Jacobian"};

/// The examination of one text.
class Examination {
 public:
  explicit Examination(const std::string& text) : text_(text) {}

  Findings run() {
    try {
      const scene::Scene s = read();
      if (findings_.reached == Reached::refused) return findings_;
      check_writing(s);
      trace(s);
    } catch (const std::exception& error) {
      fault(std::string("what is thrown is a ") + typeid(error).name() + ": " + error.what());
    }
    return findings_;
  }

 private:
  void fault(const std::string& sentence) { findings_.faults.push_back(sentence); }

  bool stands_in_text(std::string_view word) const {
    const auto same = [](char a, char b) {
      return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    };
    return std::search(text_.begin(), text_.end(), word.begin(), word.end(), same) != text_.end();
  }

  void check_message(const std::string& message) {
    if (message.empty()) fault("a message is empty");
    for (const std::string_view word : internal_words)
      if (message.find(word) != std::string::npos && !stands_in_text(word))
        fault("a message says \"" + std::string(word) + "\": " + message);
    std::string words;
    for (const char c : message)
      words += std::isalpha(static_cast<unsigned char>(c)) ? static_cast<char>(std::tolower(c)) : ' ';
    words = " " + words + " ";
    const bool about_json = message.find("JSON has no NaN and no Infinity") != std::string::npos;
    for (const std::string_view word : {"nan", "inf", "infinity"})
      if (!about_json && words.find(" " + std::string(word) + " ") != std::string::npos &&
          !stands_in_text(word))
        fault("a message says \"" + std::string(word) + "\": " + message);
  }

  /// A pointer leads to what stands in the text; what is missing there has at least a place.
  void check_pointer(const json& document, const std::string& pointer) {
    if (pointer.empty()) return;
    try {
      const json::json_pointer place(pointer);
      const auto above = place.parent_pointer();
      if (!above.empty() && !document.contains(above)) fault("a pointer leads nowhere: " + pointer);
    } catch (const json::exception&) {
      fault("a pointer is none: " + pointer);
    }
  }

  scene::Scene read() {
    try {
      std::istringstream in(text_);
      scene::Scene s = scene::read(in, test_catalogue::whole(), folder);
      findings_.reached = Reached::read;
      return s;
    } catch (const scene::SceneError& error) {
      if (error.faults().empty()) fault("a scene is refused without a fault");
      const json document = json::parse(text_, nullptr, false);
      // Of keys that stand twice the document keeps one.
      const bool certain =
          !document.is_discarded() &&
          std::none_of(error.faults().begin(), error.faults().end(), [](const scene::Fault& found) {
            return found.message.find("again") != std::string::npos;
          });
      for (const scene::Fault& found : error.faults()) {
        check_message(found.message);
        if (certain) check_pointer(document, found.pointer);
      }
    }
    return {};
  }

  void check_writing(const scene::Scene& s) {
    const std::string written = scene::write(s);
    std::istringstream in(written);
    try {
      const scene::Scene again = scene::read(in, test_catalogue::whole(), folder);
      if (!(again == s)) fault("what is written reads as another scene:\n" + written);
      if (scene::write(again) != written) fault("a scene changes when it is written twice:\n" + written);
      if (scene::hash(again) != scene::hash(s)) fault("a scene that was written has another hash");
    } catch (const scene::SceneError& error) {
      fault(std::string("what is written cannot be read: ") + error.what() + "\n" + written);
    }
  }

  /// The window in which a study of any kind looks for responses, or one at its frequency.
  static observables::FrequencyRange window(const scene::Study& study) {
    const auto range = [](double from, double to) {
      return observables::FrequencyRange{from, to > from ? to : 1.5 * from};
    };
    if (study.type == &studies::frf()) return study.settings.as<observables::FrequencyRange>();
    if (study.type == &studies::trace()) {
      const double frequency = study.settings.as<observables::ParameterRange>().frequency;
      return range(frequency, frequency);
    }
    if (study.type == &studies::time()) {
      const double frequency = study.settings.as<observables::TimeSettings>().frequency;
      return range(frequency, frequency);
    }
    if (study.type == &studies::point()) {
      const double frequency = study.settings.as<observables::PointSettings>().frequency;
      return range(frequency, frequency);
    }
    if (study.type == &optimize::optimum_type()) {
      const auto& problem = study.settings.as<optimize::OptimumSettings>().problem;
      return range(problem.frequency_from, problem.frequency_to);
    }
    if (study.type == &studies::sweep()) {
      const auto& sweep = study.settings.as<observables::SweepSettings>();
      return range(sweep.from, sweep.to);
    }
    if (study.type == &studies::accuracy()) {
      const auto& accuracy = study.settings.as<observables::AccuracySettings>();
      return range(accuracy.from, accuracy.to);
    }
    if (study.type == &studies::modes()) return {1, 10};  // they have none
    if (study.type == &studies::bifurcations()) {
      const auto& curve = study.settings.as<observables::BifurcationRange>();
      return range(curve.frequency_from, curve.frequency_to);
    }
    const auto& curve = study.settings.as<observables::CurveRange>();
    return range(curve.frequency_from, curve.frequency_to);
  }

  /// The scene with a study of little work, some with their stability; false: it is too large.
  bool make_small(scene::Scene& s) const {
    if (s.dofs.size() > most_dofs || scene::all_elements(s).size() > most_elements ||
        s.excitation.size() > most_elements)
      return false;
    for (const scene::Part& force : s.excitation)
      if (force.harmonic > highest_order) return false;
    s.harmonics.order = std::min(s.harmonics.order, highest_order);
    s.harmonics.samples = std::min(s.harmonics.samples, most_samples);
    scene::Study frf{"frf", &studies::frf(), scene::Settings::of(observables::FrequencyRange{1, 10})};
    if (!s.studies.empty()) {
      const scene::Study& first = s.studies.front();
      observables::FrequencyRange range = window(first);
      range.stability = text_.size() % 8 == 0;
      frf.settings = scene::Settings::of(range);
      std::size_t combinations = 1;
      for (const auto& [name, values] : first.for_each)
        combinations = std::min<std::size_t>(combinations * values.size(), most_combinations + 1);
      if (first.type == frf.type && combinations <= most_combinations) frf.for_each = first.for_each;
    }
    s.studies = {frf};
    return true;
  }

  void trace(scene::Scene s) {
    if (!make_small(s)) return;
    try {
      scene::check(s);
    } catch (const scene::SceneError&) {
      return;  // the window of another kind of study does not suit this one
    }
    const auto feeds = [](const scene::Part& part) { return part.type == &elements::van_der_pol(); };
    feeds_ = std::any_of(s.elements.begin(), s.elements.end(), feeds) ||
             (s.matrices && (s.matrices->circulatory.matrix || s.matrices->unsymmetric_stiffness));
    std::vector<observables::ResponseBranch> branches;
    try {
      long points = 0;
      const auto compute = [](const studies::Case& at, const control::Control& of_case) {
        return observables::frequency_response(at.scene, window(at.scene.studies.front()), of_case);
      };
      branches = studies::for_each<observables::ResponseBranch>(
          s, s.studies.front().for_each, compute,
          controls::polled([&] { return ++points % most_points != 0; }));
    } catch (const std::runtime_error& error) {
      return check_message(error.what());
    }
    findings_.reached = Reached::traced;
    if (branches.empty()) fault("no branch");
    for (const observables::ResponseBranch& branch : branches) check_branch(branch);
    check_results(s, branches);
  }

  void check_branch(const observables::ResponseBranch& branch) {
    check_message(branch.stop.message);
    if (branch.stop.reason.code.empty()) fault("a branch ends without a reason");
    if (branch.status == observables::Status::complete && branch.points.empty() &&
        branch.stop.reason != observables::reasons::unbounded)
      fault("a complete branch has no points: " + branch.stop.message);
    for (const auto& point : branch.points) check_point(point);
    for (const auto& event : branch.events) check_point(event.point);
  }

  void check_point(const observables::ResponsePoint& point) {
    if (point.unbounded) return;
    // The estimate has no value where a neglected harmonic meets an undamped resonance; it is flagged then.
    const double estimate = point.truncation_flagged ? 0 : point.truncation_estimate;
    for (const auto& [number, name] : {std::pair{point.omega, "frequency"},
                                       {point.amplitude, "amplitude"},
                                       {point.phase, "phase"},
                                       {point.energy_friction, "energy of friction"},
                                       {point.energy_viscous, "viscous energy"},
                                       {point.energy_input, "energy put in"},
                                       {estimate, "truncation estimate"}})
      if (!std::isfinite(number)) return fault("a number of a point is not finite: " + std::string(name));
    if (!(point.amplitude >= 0)) fault("an amplitude is negative");
    const double energy = std::abs(point.energy_friction) + std::abs(point.energy_viscous);
    const double least = std::min(point.energy_friction, point.energy_viscous);
    const bool held = !point.stops.empty();  // by friction without a stiffness, which is flagged
    if (least < -1e-9 * energy && !feeds_ && !held)
      fault("an energy is negative: " + std::to_string(least / energy) + " of all at " +
            std::to_string(point.omega) + " rad/s");
    for (const auto& element : point.elements) check_contact(element);
    if (!point.stability) return;
    for (const auto& multiplier : point.stability->multipliers)
      if (!std::isfinite(std::abs(multiplier))) fault("a multiplier is not finite");
  }

  void check_contact(const observables::ElementResponse& element) {
    if (!(element.stick_percent >= 0 && element.open_percent >= 0 &&
          element.stick_percent + element.open_percent <= 100 + 1e-9))
      fault("the shares of stick and separation are none");
    if (element.has_stick && !(element.normal_load_min <= element.normal_load_max))
      fault("a normal load has no range");
    if (element.mean_force_min > element.mean_force_max) fault("a mean force has no range");
    const double turn = 2 * std::numbers::pi;
    double stick = 0, all = 0;
    for (const auto& [state, begin, end] : element.contact) {
      if (!(begin >= 0 && begin < turn && end > begin)) fault("an interval of contact is none");
      all += end - begin;
      if (state == "stick") stick += end - begin;
    }
    if (element.contact.empty()) return;
    if (!(std::abs(all - turn) < 1e-6)) fault("the intervals of a contact do not fill the period");
    if (element.has_stick && !(std::abs(stick / turn - element.stick_percent / 100) < 1e-6))
      fault("the intervals of a contact have another share of stick");
  }

  void check_results(const scene::Scene& s, const std::vector<observables::ResponseBranch>& branches) {
    const results::Results all = studies::results_of(s, branches);
    std::ostringstream document;
    results::write_json(document, all);
    const json results = json::parse(document.str(), nullptr, false);
    if (results.is_discarded()) return fault("the results are no JSON:\n" + document.str());
    if (results["branches"].size() != branches.size()) fault("the results have other branches");
    for (const char* key : {"points", "events", "summary"}) {
      std::ostringstream table;
      if (key == std::string_view("summary"))
        results::write_csv_summary(table, all);
      else
        results::write_csv(table, all, key);
      if (!is_whole_table(table.str())) fault("the table is not whole:\n" + table.str().substr(0, 2000));
    }
  }

  const std::string& text_;
  bool feeds_ = false;  // an element or a matrix may feed the motion
  Findings findings_;
};

}  // namespace

Findings examine(const std::string& text) {
  return Examination(text).run();
}

}  // namespace fuzz
