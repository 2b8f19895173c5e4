#include <arcslip/scene/keys/read_text.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <filesystem>
#include <limits>

namespace arcslip::scene {

std::vector<std::string> keys_next_to(KeyType type) {
  if (type == KeyType::followed) return {"from", "to"};
  if (type == KeyType::parameters) return {"bounds"};
  return {};
}

namespace file {
namespace {

// Beyond it the square of a frequency, times a mass, may be no number any more.
constexpr double largest_frequency = 1e100;

void check_frequency(double value, const std::string& pointer, const Reading& reading) {
  if (value > largest_frequency) {
    reading.faults.add(pointer, "found " + number_text(value) + ", must be at most " +
                                    with_unit(largest_frequency, reading.frequency) +
                                    ": numbers with its square would overflow");
  }
}

void write_range(double from, double to, Node::Object& to_file) {
  to_file.push_back({"from", node(from)});
  to_file.push_back({"to", node(to)});
}

}  // namespace

std::optional<NamedFile> read_file_of(const Location& place, const std::string& what, const Reading& reading,
                                      std::size_t largest) {
  const auto path = read_string(place, what, reading.faults);
  if (!path) return {};
  for (const NamedFile& file : reading.source.read)
    if (file.path == *path) return file;
  const auto fault = [&](const std::string& why) {
    reading.faults.add(place.pointer, "found " + shown(*path) + ", which cannot be read: " + why);
  };
  try {
    const auto at = (std::filesystem::path(reading.source.folder.path) / *path).string();
    reading.source.read.push_back(
        {*path, std::make_shared<const std::string>(read_text(at, reading.source.control, "file", largest))});
    return reading.source.read.back();
  } catch (const FileError& error) {
    fault(error.what());
  } catch (const SceneError& error) {
    fault(error.faults().front().message);
  }
  return {};
}

std::pair<double, double> read_range(const Reading& reading, const Field& field) {
  const std::string wanted = allowed_text(field);
  const auto from = reading.number(reading.keys.require("from", wanted, reading.faults), field);
  const Location to_place = reading.keys.require("to", wanted, reading.faults);
  const auto to = reading.number(to_place, field);
  if (from && to && !(*from < *to)) {
    reading.faults.add(to_place.pointer, "found " + number_text(*to) + ", must be above \"from\", which is " +
                                             with_unit(*from, field));
  }
  return {from.value_or(0), to.value_or(0)};
}

std::pair<double, double> read_pair(const Reading& reading, const Location& place, const std::string& wanted,
                                    const Field& field, std::string_view what) {
  Faults& faults = reading.faults;
  const Node::List* list = read_list(place, wanted, faults);
  if (list == nullptr) return {};
  if (list->size() != 2) {
    faults.add(place.pointer, "found a list of " + std::to_string(list->size()) + ", must be " + wanted);
    return {};
  }
  const auto lower = reading.number({&list->front(), child(place.pointer, std::size_t{0})}, field);
  const auto upper = reading.number({&list->back(), child(place.pointer, std::size_t{1})}, field);
  if (lower && upper && !(*lower < *upper)) {
    faults.add(child(place.pointer, std::size_t{1}), "found " + number_text(*upper) +
                                                         ", must be above the lower " + std::string(what) +
                                                         ", which is " + with_unit(*lower, field));
  }
  return {lower.value_or(0), upper.value_or(0)};
}

void visit_pair(const std::string& pointer, std::pair<double, double>& both, const NumberVisitor& visit) {
  visit(pointer + "/0", both.first);
  visit(pointer + "/1", both.second);
}

KeyGroup<std::pair<double, double>> frequency_range() {
  return {{{"from", KeyType::frequency, "frequency", "above 0", "", false,
            "first frequency, by default one that is proposed"},
           {"to", KeyType::frequency, "frequency", "above \"from\"", "", false,
            "last frequency, by default one that is proposed"}},
          [](const Reading& reading, std::pair<double, double>& range) {
            if (!reading.keys.has("from") && !reading.keys.has("to")) return;
            range = read_range(reading, reading.frequency);
            check_frequency(range.first, reading.keys.find("from").pointer, reading);
            check_frequency(range.second, reading.keys.find("to").pointer, reading);
          },
          [](const std::pair<double, double>& range, const Scene&, Node::Object& to) {
            if (range.second == 0) return;
            write_range(range.first, range.second, to);
          },
          {},
          {},
          {},
          [](std::pair<double, double>& range, const NumberVisitor& visit) {
            visit("/from", range.first);
            visit("/to", range.second);
          }};
}

KeyGroup<RangeOver> range_over() {
  return {{{"over", KeyType::parameter, "", "a parameter \"part.field\" or a constant", "", true,
            "the parameter to vary"},
           {"from", KeyType::value, "parameter", "within the parameter's bounds", "", true,
            "first value of the parameter"},
           {"to", KeyType::value, "parameter", "above \"from\"", "", true, "last value of the parameter"}},
          [](const Reading& reading, RangeOver& range) {
            constexpr std::string_view wanted =
                "a string, the parameter \"part.field\" or constant that is varied";
            const Location over = reading.keys.require("over", std::string(wanted), reading.faults);
            const Field field = read_parameter(over, reading.parameters, range.over, reading.faults);
            std::tie(range.from, range.to) = read_range(reading, field);
          },
          [](const RangeOver& range, const Scene&, Node::Object& to) {
            to.push_back({"over", node(range.over)});
            write_range(range.from, range.to, to);
          },
          [](const RangeOver& range, std::vector<ParameterUse>& all) {
            if (!range.over.empty()) all.push_back({range.over, "which the study is \"over\""});
          },
          {},
          {},
          [](RangeOver& range, const NumberVisitor& visit) {
            visit("/from", range.from);
            visit("/to", range.to);
          }};
}

KeyGroup<std::pair<double, double>> window() {
  return {{{"frequency", KeyType::window, "frequency", "[lower, upper], 0 < lower < upper", "", false,
            "the frequency window, by default one that is proposed"}},
          [](const Reading& reading, std::pair<double, double>& ends) {
            const std::string wanted =
                "a window [lower, upper] of two frequencies, each " + allowed_text(reading.frequency);
            const Location place = reading.keys.find("frequency");
            if (place.node == nullptr) return;
            ends = read_pair(reading, place, wanted, reading.frequency, "end");
            check_frequency(ends.first, child(place.pointer, std::size_t{0}), reading);
            check_frequency(ends.second, child(place.pointer, std::size_t{1}), reading);
          },
          [](const std::pair<double, double>& ends, const Scene&, Node::Object& to) {
            if (ends.second == 0) return;
            to.push_back({"frequency", node(std::vector{ends.first, ends.second})});
          },
          {},
          {},
          {},
          [](std::pair<double, double>& ends, const NumberVisitor& visit) {
            visit_pair("/frequency", ends, visit);
          }};
}

KeyGroup<std::pair<double, double>> window_of(const Field& field, std::string help) {
  const std::string name(field.name);
  return {{{name, KeyType::window, std::string(field.unit), "[from, to], 0 < from < to", "", true,
            std::move(help)}},
          [=](const Reading& reading, std::pair<double, double>& ends) {
            const std::string wanted = "two values [from, to], each " + allowed_text(field);
            ends =
                read_pair(reading, reading.keys.require(name, wanted, reading.faults), wanted, field, "end");
          },
          [=](const std::pair<double, double>& ends, const Scene&, Node::Object& to) {
            to.push_back({name, node(std::vector{ends.first, ends.second})});
          },
          {},
          {},
          {},
          [=](std::pair<double, double>& ends, const NumberVisitor& visit) {
            visit_pair('/' + name, ends, visit);
          }};
}

KeyGroup<double> one_frequency(std::string help) {
  return {{{"frequency", KeyType::frequency, "frequency", "above 0", "", true, std::move(help)}},
          [](const Reading& reading, double& frequency) {
            const std::string wanted = "one frequency, " + allowed_text(reading.frequency);
            const Location place = reading.keys.require("frequency", wanted, reading.faults);
            frequency = 0;
            if (place.node != nullptr && place.node->get<Node::List>() != nullptr)
              return add_wrong_type(place, wanted, reading.faults);
            frequency = reading.number(place, reading.frequency).value_or(0);
            check_frequency(frequency, place.pointer, reading);
          },
          [](const double& frequency, const Scene&, Node::Object& to) {
            to.push_back({"frequency", node(frequency)});
          },
          {},
          {},
          {},
          [](double& frequency, const NumberVisitor& visit) { visit("/frequency", frequency); }};
}

KeyGroup<double> number(const Field& field, double otherwise, std::string help) {
  const std::string name(field.name);
  return {{{name, KeyType::number, std::string(field.unit), allowed_text(field), json_text(node(otherwise)),
            false, std::move(help), field.lower, field.upper, field.lower_open}},
          [=](const Reading& reading, double& value) {
            value = reading.number(reading.keys.find(name), field).value_or(value);
          },
          [=](const double& value, const Scene&, Node::Object& to) { to.push_back({name, node(value)}); },
          {},
          {},
          {},
          [=](double& value, const NumberVisitor& visit) { visit('/' + name, value); }};
}

KeyGroup<int> whole(const std::string& name, int otherwise, int lower, int upper, std::string help) {
  return {{{name, KeyType::whole, "-",
            "an integer from " + std::to_string(lower) + " to " + std::to_string(upper),
            json_text(node(otherwise)), false, std::move(help), static_cast<double>(lower),
            static_cast<double>(upper)}},
          [=](const Reading& reading, int& value) {
            value = read_integer(reading.keys.find(name), lower, upper, reading.faults).value_or(value);
          },
          [=](const int& value, const Scene&, Node::Object& to) { to.push_back({name, node(value)}); }};
}

KeyGroup<std::string> text(const std::string& name, const std::string& what, std::string otherwise,
                           std::string help) {
  return {{{name, KeyType::text, "", what, std::move(otherwise), false, std::move(help)}},
          [=](const Reading& reading, std::string& value) {
            value = read_string(reading.keys.find(name), what, reading.faults).value_or(value);
          },
          [=](const std::string& value, const Scene&, Node::Object& to) {
            if (!value.empty()) to.push_back({name, node(value)});
          }};
}

KeyGroup<NamedFile> named_file(const std::string& name, const std::string& what, std::string help) {
  return {
      {{name, KeyType::text, "", what, "", true, std::move(help)}},
      [=](const Reading& reading, NamedFile& value) {
        value = read_file_of(reading.keys.require(name, what, reading.faults), what, reading).value_or(value);
      },
      [=](const NamedFile& value, const Scene&, Node::Object& to) { to.push_back({name, node(value.path)}); },
      {},
      {},
      [](NamedFile& value, std::vector<NamedFile*>& files) { files.push_back(&value); }};
}

Key word_key(const std::string& name, std::vector<std::string> words, std::string_view otherwise,
             std::string help) {
  return {name,
          KeyType::word,
          "",
          "one of " + listed(words),
          json_text(node(otherwise)),
          false,
          std::move(help),
          0,
          0,
          false,
          words};
}

KeyGroup<bool> flag(const std::string& name, bool otherwise, std::string help) {
  Key key{name, KeyType::other, "", "true or false", otherwise ? "true" : "false", false, std::move(help)};
  key.schema = R"({"type": "boolean"})";
  return {{key},
          [name, allowed = key.allowed](const Reading& reading, bool& value) {
            const Location place = reading.keys.find(name);
            if (place.node == nullptr) return;
            if (const bool* is = place.node->get<bool>())
              value = *is;
            else
              add_wrong_type(place, allowed, reading.faults);
          },
          [=](const bool& value, const Scene&, Node::Object& to) { to.push_back({name, Node{value}}); }};
}

}  // namespace file

const PartType* Catalogue::element(std::string_view name) const {
  for (const auto& type : elements)
    if (type->name() == name) return type.get();
  return nullptr;
}

const StudyType* Catalogue::study(std::string_view name) const {
  for (const auto& type : studies)
    if (type->name() == name) return type.get();
  return nullptr;
}

}  // namespace arcslip::scene
