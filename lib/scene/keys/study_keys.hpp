#pragma once
// The keys of a kind of study: name, allowed values and target of each in one place, from which reader,
// writer, command line options and documentation are derived.
//
//   struct Window { std::string over; double from = 0, to = 0, lower = 0, upper = 0; };
//   KeysOf<Window> keys;
//   keys.add(range_over(&Window::over, &Window::from, &Window::to, "the parameter to vary"));
//   keys.add(window(&Window::lower, &Window::upper, "the search window"));

#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/keys/read_values.hpp>
#include <arcslip/scene/keys/study_parameters.hpp>
#include <arcslip/scene/keys/write_values.hpp>
#include <arcslip/scene/study_type.hpp>

#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace arcslip::scene::file {

/// The object of a study while it is read, with the context of its values.
struct Reading {
  const Keys& keys;
  const Field& frequency;  // in the scene's unit
  const Parameters& parameters;
  const Dofs& dofs;
  Faults& faults;
  const FileSource& source;

  /// A number that may be a formula, which it follows from then on.
  std::optional<double> number(const Location& place, const Field& field) const {
    return read_followed_number(place, field, keys.pointer(), parameters, faults);
  }
};

/// Some keys of a study that are read and written together.
template <class Settings>
struct KeyGroup {
  std::vector<Key> keys;
  std::function<void(const Reading&, Settings&)> read;
  std::function<void(const Settings&, const Scene&, Node::Object&)> write;
  std::function<void(const Settings&, std::vector<ParameterUse>&)>
      taken{};                                                       // parameters with values in these keys
  std::function<void(std::string_view, Settings&)> drop{};           // a parameter from lists of values
  std::function<void(Settings&, std::vector<NamedFile*>&)> files{};  // that are named here
  std::function<void(Settings&, const NumberVisitor&)> numbers{};    // that may follow parameters
  std::function<WindowEnds(Settings&)> window{};                     // of frequencies
};

/// A part of the settings as a group of its own: settings within settings, or a single value.
template <class S, class Part>
KeyGroup<S> within(Part S::*part, KeyGroup<Part> group) {
  KeyGroup<S> all{
      std::move(group.keys),
      [part, read = std::move(group.read)](const Reading& reading, S& s) { read(reading, s.*part); },
      [part, write = std::move(group.write)](const S& s, const Scene& scene, Node::Object& to) {
        write(s.*part, scene, to);
      }};
  if (group.taken)
    all.taken = [part, of = std::move(group.taken)](const S& s, std::vector<ParameterUse>& taken) {
      of(s.*part, taken);
    };
  if (group.drop)
    all.drop = [part, of = std::move(group.drop)](std::string_view parameter, S& s) {
      of(parameter, s.*part);
    };
  if (group.files)
    all.files = [part, of = std::move(group.files)](S& s, std::vector<NamedFile*>& files) {
      of(s.*part, files);
    };
  if (group.numbers)
    all.numbers = [part, of = std::move(group.numbers)](S& s, const NumberVisitor& visit) {
      of(s.*part, visit);
    };
  if (group.window) all.window = [part, of = std::move(group.window)](S& s) { return of(s.*part); };
  return all;
}

/// Two values as a group of a pair.
template <class S>
KeyGroup<S> within(double S::*first, double S::*second, KeyGroup<std::pair<double, double>> group) {
  return {std::move(group.keys),
          [=, read = std::move(group.read)](const Reading& reading, S& s) {
            std::pair<double, double> both{s.*first, s.*second};
            read(reading, both);
            std::tie(s.*first, s.*second) = both;
          },
          [=, write = std::move(group.write)](const S& s, const Scene& scene, Node::Object& to) {
            write({s.*first, s.*second}, scene, to);
          },
          {},
          {},
          {},
          [=, numbers = std::move(group.numbers)](S& s, const NumberVisitor& visit) {
            std::pair<double, double> both{s.*first, s.*second};
            numbers(both, visit);
            std::tie(s.*first, s.*second) = both;
          }};
}

/// The same of a window of frequencies.
template <class S>
KeyGroup<S> window_within(double S::*lower, double S::*upper, KeyGroup<std::pair<double, double>> group) {
  KeyGroup<S> all = within(lower, upper, std::move(group));
  all.window = [=](S& s) { return WindowEnds{&(s.*lower), &(s.*upper)}; };
  return all;
}

// Standard groups of keys, defined by the targets of their values: of a value alone, which is compiled once,
// and of members of settings. A missing or invalid value leaves its target unchanged.

/// A pair [lower, upper] of values of a field, lower < upper; zeros after a fault. what: the noun in
/// messages, "bound".
std::pair<double, double> read_pair(const Reading& reading, const Location& place, const std::string& wanted,
                                    const Field& field, std::string_view what);
/// Visits both numbers of a list at a pointer.
void visit_pair(const std::string& pointer, std::pair<double, double>& both, const NumberVisitor& visit);

/// "from" and "to" of a field, from < to.
std::pair<double, double> read_range(const Reading& reading, const Field& field);

/// "from" and "to" in the unit of the scene's frequencies, from < to. Both may be left out, and are 0 then.
KeyGroup<std::pair<double, double>> frequency_range();
template <class S>
KeyGroup<S> frequency_range(double S::*from, double S::*to) {
  return window_within(from, to, frequency_range());
}

/// "over", a parameter, and its range "from" and "to".
struct RangeOver {
  std::string over;
  double from = 0, to = 0;
};
KeyGroup<RangeOver> range_over();
template <class S>
KeyGroup<S> range_over(std::string S::*over, double S::*from, double S::*to) {
  KeyGroup<RangeOver> range = range_over();
  return {std::move(range.keys),
          [=, read = std::move(range.read)](const Reading& reading, S& s) {
            RangeOver all;
            read(reading, all);
            std::tie(s.*over, s.*from, s.*to) = std::tie(all.over, all.from, all.to);
          },
          [=, write = std::move(range.write)](const S& s, const Scene& scene, Node::Object& to_file) {
            write({s.*over, s.*from, s.*to}, scene, to_file);
          },
          [=, taken = std::move(range.taken)](const S& s, std::vector<ParameterUse>& all) {
            taken({s.*over, s.*from, s.*to}, all);
          },
          {},
          {},
          [=, numbers = std::move(range.numbers)](S& s, const NumberVisitor& visit) {
            RangeOver all{s.*over, s.*from, s.*to};
            numbers(all, visit);
            std::tie(s.*from, s.*to) = std::tie(all.from, all.to);
          }};
}

/// "frequency": a window [lower, upper] of frequencies. It may be left out; its ends are 0 then.
KeyGroup<std::pair<double, double>> window();
template <class S>
KeyGroup<S> window(double S::*lower, double S::*upper) {
  return window_within(lower, upper, window());
}

/// A window of another field, whose bounds are open at 0.
KeyGroup<std::pair<double, double>> window_of(const Field& field, std::string help);
template <class S>
KeyGroup<S> window_of(double S::*lower, double S::*upper, const Field& field, std::string help) {
  return within(lower, upper, window_of(field, std::move(help)));
}

/// "frequency": a single one.
KeyGroup<double> one_frequency(std::string help);
template <class S>
KeyGroup<S> one_frequency(double S::*frequency, std::string help) {
  return within(frequency, one_frequency(std::move(help)));
}

/// A number with a default. field: its name, unit and bounds.
KeyGroup<double> number(const Field& field, double otherwise, std::string help);
template <class S>
KeyGroup<S> number(double S::*value, const Field& field, std::string help) {
  return within(value, number(field, S{}.*value, std::move(help)));
}

/// A whole number with a default.
KeyGroup<int> whole(const std::string& name, int otherwise, int lower, int upper, std::string help);
template <class S>
KeyGroup<S> whole(const std::string& name, int S::*value, int lower, int upper, std::string help) {
  return within(value, whole(name, S{}.*value, lower, upper, std::move(help)));
}

/// An optional text. what: "a string, the name of an NLopt algorithm".
KeyGroup<std::string> text(const std::string& name, const std::string& what, std::string otherwise,
                           std::string help);
template <class S>
KeyGroup<S> text(const std::string& name, std::string S::*value, const std::string& what,
                 std::string otherwise, std::string help) {
  return within(value, text(name, what, std::move(otherwise), std::move(help)));
}

/// The text of a file, of at most so many bytes.
std::optional<NamedFile> read_file_of(const Location& place, const std::string& what, const Reading& reading,
                                      std::size_t largest = largest_size);

/// "for_each": lists of values by parameter, a list of rows, the path of a CSV file with rows, or samples.
void read_for_each(const Location& place, const Reading& reading, const std::vector<ParameterUse>& taken,
                   Study& study);

/// The path of a file, which is read with the scene. what: "a string, the path of a table of q and f".
KeyGroup<NamedFile> named_file(const std::string& name, const std::string& what, std::string help);
template <class S>
KeyGroup<S> named_file(const std::string& name, NamedFile S::*value, const std::string& what,
                       std::string help) {
  return within(value, named_file(name, what, std::move(help)));
}

/// One of a few words with a default.
Key word_key(const std::string& name, std::vector<std::string> words, std::string_view otherwise,
             std::string help);
template <class S, class Choice, class Words>
KeyGroup<S> word(const std::string& name, Choice S::*value, const Words& words, std::string help) {
  return {{word_key(name, texts(words), word_of(words, S{}.*value), std::move(help))},
          [=](const Reading& reading, S& s) {
            s.*value = read_choice(reading.keys.find(name), words, s.*value, reading.faults);
          },
          [=](const S& s, const Scene&, Node::Object& to_file) {
            to_file.push_back({name, node(word_of(words, s.*value))});
          }};
}

/// True or false, with a default.
KeyGroup<bool> flag(const std::string& name, bool otherwise, std::string help);
template <class S>
KeyGroup<S> flag(const std::string& name, bool S::*value, std::string help) {
  return within(value, flag(name, S{}.*value, std::move(help)));
}

template <class S>
class KeysOf final : public SettingsKeys {
 public:
  void add(KeyGroup<S> group) { groups_.push_back(std::move(group)); }
  /// A check of several values together, called when all are read.
  void check(std::function<void(const Reading&, S&)> check) { check_ = std::move(check); }

  std::vector<Key> keys() const override {
    std::vector<Key> all;
    for (const auto& group : groups_) all.insert(all.end(), group.keys.begin(), group.keys.end());
    return all;
  }
  Settings defaults() const override { return Settings::of(S{}); }
  Settings read(const Reading& from) const override {
    S settings;
    for (const auto& group : groups_) group.read(from, settings);
    if (check_) check_(from, settings);
    return Settings::of(std::move(settings));
  }
  void write(const Settings& settings, const Scene& scene, Node::Object& to) const override {
    const S values = values_of(settings);
    for (const auto& group : groups_) group.write(values, scene, to);
  }
  std::vector<ParameterUse> taken(const Settings& settings) const override {
    const S values = values_of(settings);
    std::vector<ParameterUse> all;
    for (const auto& group : groups_)
      if (group.taken) group.taken(values, all);
    return all;
  }
  void drop(std::string_view parameter, Settings& settings) const override {
    for (const auto& group : groups_)
      if (group.drop && !settings.empty()) group.drop(parameter, settings.as<S>());
  }
  void visit_numbers(Settings& settings, const NumberVisitor& visit) const override {
    for (const auto& group : groups_)
      if (group.numbers && !settings.empty()) group.numbers(settings.as<S>(), visit);
  }
  std::vector<NamedFile*> files(Settings& settings) const override {
    std::vector<NamedFile*> all;
    for (const auto& group : groups_)
      if (group.files && !settings.empty()) group.files(settings.as<S>(), all);
    return all;
  }
  std::optional<WindowEnds> window(Settings& settings) const override {
    for (const auto& group : groups_)
      if (group.window && !settings.empty()) return group.window(settings.as<S>());
    return {};
  }

 private:
  static S values_of(const Settings& settings) { return settings.empty() ? S{} : settings.as<S>(); }

  std::vector<KeyGroup<S>> groups_;
  std::function<void(const Reading&, S&)> check_;
};

/// The part of a PartType that its options decide. Base: PartType, or what derives from it.
template <class S, class Base>
class KeyedPart : public Base {
 public:
  explicit KeyedPart(KeysOf<S> options) : options_(std::move(options)) {}
  std::vector<Key> options() const override { return options_.keys(); }
  Settings read_options(const Reading& from) const override { return options_.read(from); }
  void write_options(const Settings& options, const Scene& scene, Node::Object& to) const override {
    options_.write(options, scene, to);
  }
  std::vector<NamedFile*> files(Settings& options) const override { return options_.files(options); }

 private:
  KeysOf<S> options_;
};

}  // namespace arcslip::scene::file
