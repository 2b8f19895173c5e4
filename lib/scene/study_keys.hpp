#pragma once
// The keys of a kind of study: name, allowed values and target of each in one place, from which reader,
// writer, command line options and documentation are derived.
//
//   struct Window { std::string over; double from = 0, to = 0, lower = 0, upper = 0; };
//   KeysOf<Window> keys;
//   keys.add(range_over(&Window::over, &Window::from, &Window::to, "the parameter to vary"));
//   keys.add(window(&Window::lower, &Window::upper, "the search window"));

#include <arcslip/scene/read_parts.hpp>
#include <arcslip/scene/read_values.hpp>
#include <arcslip/scene/study_parameters.hpp>
#include <arcslip/scene/study_type.hpp>
#include <arcslip/scene/words.hpp>
#include <arcslip/scene/write_values.hpp>

#include <functional>
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
};

/// Some keys of a study that are read and written together.
template <class Settings>
struct KeyGroup {
  std::vector<Key> keys;
  std::function<void(const Reading&, Settings&)> read;
  std::function<void(const Settings&, const Scene&, Node::Object&)> write;
  std::function<void(const Settings&, std::vector<Taken>&)> taken{};  // parameters with values in these keys
  std::function<void(std::string_view, Settings&)> drop{};            // a parameter from lists of values
  std::function<void(Settings&, std::vector<NamedFile*>&)> files{};   // that are named here
};

// Standard groups of keys, defined by the targets of their values. A missing or invalid value leaves its
// target unchanged.

/// "from" and "to" in the unit of the scene's frequencies, from < to.
std::pair<double, double> read_frequency_range(const Reading& reading);
/// "over", a parameter, and its range "from" and "to".
struct RangeOver {
  std::string over;
  double from = 0, to = 0;
};
RangeOver read_range_over(const Reading& reading);
/// "frequency": a window [lower, upper], or a single frequency.
std::pair<double, double> read_window(const Reading& reading);
/// A window [lower, upper] of a field, under its name.
std::pair<double, double> read_window(const Reading& reading, const Field& field);
double read_frequency(const Reading& reading);
/// "from" and "to" of a field.
std::pair<double, double> read_range(const Reading& reading, const Field& field);

template <class S>
KeyGroup<S> frequency_range(double S::*from, double S::*to) {
  return {{{"from", KeyType::frequency, "frequency", "above 0", "", true, "first frequency"},
           {"to", KeyType::frequency, "frequency", "above \"from\"", "", true, "last frequency"}},
          [=](const Reading& reading, S& s) { std::tie(s.*from, s.*to) = read_frequency_range(reading); },
          [=](const S& s, const Scene&, Node::Object& to_file) {
            to_file.push_back({"from", node(s.*from)});
            to_file.push_back({"to", node(s.*to)});
          }};
}

template <class S>
KeyGroup<S> range_over(std::string S::*over, double S::*from, double S::*to) {
  return {{{"over", KeyType::parameter, "", "a parameter \"part.field\" or a tie", "", true,
            "the parameter to vary"},
           {"from", KeyType::value, "parameter", "within the parameter's bounds", "", true,
            "first value of the parameter"},
           {"to", KeyType::value, "parameter", "above \"from\"", "", true, "last value of the parameter"}},
          [=](const Reading& reading, S& s) {
            const RangeOver range = read_range_over(reading);
            s.*over = range.over;
            s.*from = range.from;
            s.*to = range.to;
          },
          [=](const S& s, const Scene&, Node::Object& to_file) {
            to_file.push_back({"over", node(s.*over)});
            to_file.push_back({"from", node(s.*from)});
            to_file.push_back({"to", node(s.*to)});
          },
          [=](const S& s, std::vector<Taken>& all) {
            if (!(s.*over).empty()) all.push_back({s.*over, "which the study is \"over\""});
          }};
}

template <class S>
KeyGroup<S> window(double S::*lower, double S::*upper) {
  return {{{"frequency", KeyType::window, "frequency", "[lower, upper], 0 < lower < upper", "", true,
            "the frequency window"}},
          [=](const Reading& reading, S& s) { std::tie(s.*lower, s.*upper) = read_window(reading); },
          [=](const S& s, const Scene&, Node::Object& to_file) {
            to_file.push_back({"frequency", node(std::vector{s.*lower, s.*upper})});
          }};
}

/// A window of another field, whose bounds are open at 0.
template <class S>
KeyGroup<S> window_of(double S::*lower, double S::*upper, const Field& field, std::string help) {
  const std::string name(field.name);
  return {{{name, KeyType::window, std::string(field.unit), "[from, to], 0 < from < to", "", true,
            std::move(help)}},
          [=](const Reading& reading, S& s) { std::tie(s.*lower, s.*upper) = read_window(reading, field); },
          [=](const S& s, const Scene&, Node::Object& to_file) {
            to_file.push_back({name, node(std::vector{s.*lower, s.*upper})});
          }};
}

template <class S>
KeyGroup<S> one_frequency(double S::*frequency, std::string help) {
  return {{{"frequency", KeyType::frequency, "frequency", "above 0", "", true, std::move(help)}},
          [=](const Reading& reading, S& s) { s.*frequency = read_frequency(reading); },
          [=](const S& s, const Scene&, Node::Object& to_file) {
            to_file.push_back({"frequency", node(s.*frequency)});
          }};
}

/// A number with a default. field: its name, unit and bounds.
template <class S>
KeyGroup<S> number(double S::*value, const Field& field, std::string help) {
  const std::string name(field.name);
  return {{{name, KeyType::number, std::string(field.unit), allowed_text(field), json_text(node(S{}.*value)),
            false, std::move(help), field.lower, field.upper, field.lower_open}},
          [=](const Reading& reading, S& s) {
            s.*value = read_number(reading.keys.find(name), field, reading.faults).value_or(s.*value);
          },
          [=](const S& s, const Scene&, Node::Object& to_file) {
            to_file.push_back({name, node(s.*value)});
          }};
}

/// A whole number with a default.
template <class S>
KeyGroup<S> whole(const std::string& name, int S::*value, int lower, int upper, std::string help) {
  return {{{name, KeyType::whole, "-",
            "an integer from " + std::to_string(lower) + " to " + std::to_string(upper),
            json_text(node(S{}.*value)), false, std::move(help), static_cast<double>(lower),
            static_cast<double>(upper)}},
          [=](const Reading& reading, S& s) {
            s.*value = read_integer(reading.keys.find(name), lower, upper, reading.faults).value_or(s.*value);
          },
          [=](const S& s, const Scene&, Node::Object& to_file) {
            to_file.push_back({name, node(s.*value)});
          }};
}

/// An optional text. what: "a string, the name of an NLopt algorithm".
template <class S>
KeyGroup<S> text(const std::string& name, std::string S::*value, const std::string& what,
                 std::string otherwise, std::string help) {
  return {{{name, KeyType::text, "", what, std::move(otherwise), false, std::move(help)}},
          [=](const Reading& reading, S& s) {
            s.*value = read_string(reading.keys.find(name), what, reading.faults).value_or(s.*value);
          },
          [=](const S& s, const Scene&, Node::Object& to_file) {
            if (!(s.*value).empty()) to_file.push_back({name, node(s.*value)});
          }};
}

/// The text of a file, of at most so many bytes.
std::optional<NamedFile> read_file_of(const Location& place, const std::string& what, const Reading& reading,
                                      std::size_t largest = largest_size);

/// The path of a file, which is read with the scene. what: "a string, the path of a table of q and f".
template <class S>
KeyGroup<S> named_file(const std::string& name, NamedFile S::*value, const std::string& what,
                       std::string help) {
  return {
      {{name, KeyType::text, "", what, "", true, std::move(help)}},
      [=](const Reading& reading, S& s) {
        s.*value =
            read_file_of(reading.keys.require(name, what, reading.faults), what, reading).value_or(s.*value);
      },
      [=](const S& s, const Scene&, Node::Object& to_file) {
        to_file.push_back({name, node((s.*value).path)});
      },
      {},
      {},
      [=](S& s, std::vector<NamedFile*>& files) { files.push_back(&(s.*value)); }};
}

/// One of a few words with a default.
template <class S, class Choice, class Words>
KeyGroup<S> word(const std::string& name, Choice S::*value, const Words& words, std::string help) {
  return {{{name, KeyType::word, "", "one of " + listed(texts(words)),
            json_text(node(word_of(words, S{}.*value))), false, std::move(help), 0, 0, false, texts(words)}},
          [=](const Reading& reading, S& s) {
            s.*value = read_choice(reading.keys.find(name), words, s.*value, reading.faults);
          },
          [=](const S& s, const Scene&, Node::Object& to_file) {
            to_file.push_back({name, node(word_of(words, s.*value))});
          }};
}

/// True or false, with a default.
template <class S>
KeyGroup<S> flag(const std::string& name, bool S::*value, std::string help) {
  Key key{name, KeyType::other, "", "true or false", S{}.*value ? "true" : "false", false, std::move(help)};
  key.schema = R"({"type": "boolean"})";
  return {{key},
          [=](const Reading& reading, S& s) {
            const Location place = reading.keys.find(name);
            if (place.node == nullptr) return;
            if (const bool* is = place.node->get<bool>())
              s.*value = *is;
            else
              add_wrong_type(place, key.allowed, reading.faults);
          },
          [=](const S& s, const Scene&, Node::Object& to_file) {
            to_file.push_back({name, Node{s.*value}});
          }};
}

/// Keys of settings within settings.
template <class S, class Part>
KeyGroup<S> within(Part S::*part, KeyGroup<Part> group) {
  KeyGroup<S> all{
      group.keys, [=](const Reading& reading, S& s) { group.read(reading, s.*part); },
      [=](const S& s, const Scene& scene, Node::Object& to_file) { group.write(s.*part, scene, to_file); }};
  if (group.taken) all.taken = [=](const S& s, std::vector<Taken>& taken) { group.taken(s.*part, taken); };
  if (group.drop) all.drop = [=](std::string_view parameter, S& s) { group.drop(parameter, s.*part); };
  if (group.files) all.files = [=](S& s, std::vector<NamedFile*>& files) { group.files(s.*part, files); };
  return all;
}

template <class S>
class KeysOf {
 public:
  void add(KeyGroup<S> group) { groups_.push_back(std::move(group)); }
  /// A check of several values together, called when all are read.
  void check(std::function<void(const Reading&, S&)> check) { check_ = std::move(check); }

  std::vector<Key> keys() const {
    std::vector<Key> all;
    for (const auto& group : groups_) all.insert(all.end(), group.keys.begin(), group.keys.end());
    return all;
  }
  S read(const Reading& from) const {
    S settings;
    for (const auto& group : groups_) group.read(from, settings);
    if (check_) check_(from, settings);
    return settings;
  }
  void write(const S& settings, const Scene& scene, Node::Object& to) const {
    for (const auto& group : groups_) group.write(settings, scene, to);
  }
  std::vector<Taken> taken(const S& settings) const {
    std::vector<Taken> all;
    for (const auto& group : groups_)
      if (group.taken) group.taken(settings, all);
    return all;
  }
  void drop(std::string_view parameter, S& settings) const {
    for (const auto& group : groups_)
      if (group.drop) group.drop(parameter, settings);
  }

  std::vector<NamedFile*> files(S& settings) const {
    std::vector<NamedFile*> all;
    for (const auto& group : groups_)
      if (group.files) group.files(settings, all);
    return all;
  }

 private:
  std::vector<KeyGroup<S>> groups_;
  std::function<void(const Reading&, S&)> check_;
};

/// The part of a PartType that its options decide. Base: PartType, or what derives from it.
template <class S, class Base>
class KeyedPart : public Base {
 public:
  explicit KeyedPart(KeysOf<S> options) : options_(std::move(options)) {}
  std::vector<Key> options() const override { return options_.keys(); }
  Settings read_options(const Reading& from) const override { return Settings::of(options_.read(from)); }
  void write_options(const Settings& options, const Scene& scene, Node::Object& to) const override {
    options_.write(options.empty() ? S{} : options.as<S>(), scene, to);
  }
  std::vector<NamedFile*> files(Settings& options) const override {
    return options.empty() ? std::vector<NamedFile*>() : options_.files(options.as<S>());
  }

 private:
  KeysOf<S> options_;
};

/// The part of a StudyType that its keys decide.
template <class S>
class KeyedStudy : public StudyType {
 public:
  explicit KeyedStudy(KeysOf<S> keys) : keys_(std::move(keys)) {}
  std::vector<Key> keys() const override { return keys_.keys(); }
  Settings defaults() const override { return Settings::of(S{}); }
  Settings read(const Reading& from) const override { return Settings::of(keys_.read(from)); }
  void write(const Settings& settings, const Scene& scene, Node::Object& to) const override {
    keys_.write(settings.empty() ? S{} : settings.as<S>(), scene, to);
  }
  std::vector<NamedFile*> files(Settings& settings) const override {
    return settings.empty() ? std::vector<NamedFile*>() : keys_.files(settings.as<S>());
  }
  std::vector<Taken> taken(const Settings& settings) const override {
    return keys_.taken(settings.empty() ? S{} : settings.as<S>());
  }
  void drop(std::string_view parameter, Settings& settings) const override {
    if (!settings.empty()) keys_.drop(parameter, settings.as<S>());
  }

 private:
  KeysOf<S> keys_;
};

}  // namespace arcslip::scene::file
