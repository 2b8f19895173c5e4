#pragma once
// The words of enumerated values in a scene file, for reading and writing.

#include <arcslip/scene/scene.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::scene::file {

inline constexpr std::string_view format_name = "arcslip-scene-2";
/// With "ties" in place of formulas.
inline constexpr std::string_view first_format_name = "arcslip-scene-1";
inline constexpr std::string_view ground = "ground";
inline constexpr std::string_view next_key = "next";  // of a place of the next sector

enum class Spacing { linear, logarithmic };  // of the values of a range

template <class Choice>
struct Word {
  std::string_view text;
  Choice value;
};

inline constexpr std::array<Word<FrequencyUnit>, 2> frequency_units = {
    {{"Hz", FrequencyUnit::hertz}, {"rad/s", FrequencyUnit::radian_per_second}}};
inline constexpr std::array<Word<Spacing>, 2> spacings = {
    {{"linear", Spacing::linear}, {"logarithmic", Spacing::logarithmic}}};
inline constexpr std::array<Word<Frame>, 2> frames = {
    {{"relative", Frame::relative}, {"absolute", Frame::absolute}}};
inline constexpr std::array<Word<BarEnd>, 3> bar_ends = {
    {{"clamped", BarEnd::clamped}, {"pinned", BarEnd::pinned}, {"free", BarEnd::free}}};
inline constexpr std::array<Word<Friction>, 2> friction_methods = {
    {{"exact", Friction::exact}, {"sampled", Friction::sampled}}};
inline constexpr std::array<Word<Kinks>, 3> kinks_words = {
    {{"auto", Kinks::automatic}, {"located", Kinks::located}, {"passed", Kinks::passed}}};

/// Names of quantities in results, which the continuation parameter of a study must not have.
inline constexpr std::array<std::string_view, 42> result_names = {"kind",
                                                                  "stable",
                                                                  "unstable_multipliers",
                                                                  "multipliers",
                                                                  "multiplier_error",
                                                                  "rotation_number",
                                                                  "synthesis",
                                                                  "nonsmooth",
                                                                  "located",
                                                                  "omega",
                                                                  "amplitude",
                                                                  "unbounded",
                                                                  "phase",
                                                                  "truncation_estimate",
                                                                  "truncation_flagged",
                                                                  "location_estimate",
                                                                  "parameter_estimate",
                                                                  "rms",
                                                                  "energy_friction",
                                                                  "energy_viscous",
                                                                  "energy_total",
                                                                  "energy_input",
                                                                  "friction_percent",
                                                                  "damping_ratio",
                                                                  "energy",
                                                                  "force_per_displacement",
                                                                  "maxima",
                                                                  "stick_percent",
                                                                  "stick_estimate",
                                                                  "open_percent",
                                                                  "normal_load_max",
                                                                  "normal_load_min",
                                                                  "elements",
                                                                  "patches",
                                                                  "wear_rate",
                                                                  "responses",
                                                                  "coefficients",
                                                                  "after",
                                                                  "feasible",
                                                                  "peaks",
                                                                  "at_bound",
                                                                  "minimum"};

/// Quantities that are not parameters and may have a label in figures.
inline constexpr std::array<std::string_view, 3> label_names = {"frequency", "amplitude", "displacement"};

template <class Words>
std::vector<std::string> texts(const Words& words) {
  std::vector<std::string> result;
  for (const auto& word : words) result.emplace_back(word.text);
  return result;
}

/// The word of a value.
template <class Words, class Choice>
constexpr std::string_view word_of(const Words& words, Choice value) {
  for (const auto& word : words)
    if (word.value == value) return word.text;
  return {};
}

/// The value of a word, or none.
template <class Choice, class Words>
std::optional<Choice> value_of(const Words& words, std::string_view text) {
  for (const auto& word : words)
    if (word.text == text) return word.value;
  return std::nullopt;
}

}  // namespace arcslip::scene::file
