#include <arcslip/scene/read_text.hpp>
#include <arcslip/scene/study_keys.hpp>

#include <filesystem>
#include <limits>

namespace arcslip::scene {

std::vector<std::string> keys_beside(KeyType type) {
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
        {*path, std::make_shared<const std::string>(read_text(at, reading.source.stop, "file", largest))});
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
  const auto from = read_number(reading.keys.require("from", wanted, reading.faults), field, reading.faults);
  const Location to_place = reading.keys.require("to", wanted, reading.faults);
  const auto to = read_number(to_place, field, reading.faults);
  if (from && to && !(*from < *to)) {
    reading.faults.add(to_place.pointer, "found " + number_text(*to) + ", must be above \"from\", which is " +
                                             with_unit(*from, field));
  }
  return {from.value_or(0), to.value_or(0)};
}

std::pair<double, double> read_frequency_range(const Reading& reading) {
  const auto range = read_range(reading, reading.frequency);
  check_frequency(range.first, reading.keys.find("from").pointer, reading);
  check_frequency(range.second, reading.keys.find("to").pointer, reading);
  return range;
}

RangeOver read_range_over(const Reading& reading) {
  constexpr std::string_view wanted = "a string, the parameter \"part.field\" or tie that is varied";
  RangeOver range;
  const Location over = reading.keys.require("over", std::string(wanted), reading.faults);
  const Field field = read_parameter(over, reading.parameters, range.over, reading.faults);
  std::tie(range.from, range.to) = read_range(reading, field);
  return range;
}

std::pair<double, double> read_window(const Reading& reading) {
  const std::string wanted =
      "a window [lower, upper] of two frequencies, each " + allowed_text(reading.frequency);
  const Location place = reading.keys.require("frequency", wanted, reading.faults);
  const auto window = read_pair(place, wanted, reading.frequency, "end", reading.faults);
  check_frequency(window.first, child(place.pointer, std::size_t{0}), reading);
  check_frequency(window.second, child(place.pointer, std::size_t{1}), reading);
  return window;
}

std::pair<double, double> read_window(const Reading& reading, const Field& field) {
  const std::string name(field.name);
  const std::string wanted = "two values [from, to], each " + allowed_text(field);
  return read_pair(reading.keys.require(name, wanted, reading.faults), wanted, field, "end", reading.faults);
}

double read_frequency(const Reading& reading) {
  const std::string wanted = "one frequency, " + allowed_text(reading.frequency);
  const Location place = reading.keys.require("frequency", wanted, reading.faults);
  if (place.node != nullptr && place.node->get<Node::List>() != nullptr) {
    add_wrong_type(place, wanted, reading.faults);
    return 0;
  }
  const double frequency = read_number(place, reading.frequency, reading.faults).value_or(0);
  check_frequency(frequency, place.pointer, reading);
  return frequency;
}

}  // namespace file

const PartType* Catalogue::element(std::string_view name) const {
  for (const PartType* type : elements)
    if (type->name() == name) return type;
  return nullptr;
}

const StudyType* Catalogue::study(std::string_view name) const {
  for (const StudyType* type : studies)
    if (type->name() == name) return type;
  return nullptr;
}

}  // namespace arcslip::scene
