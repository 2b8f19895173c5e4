// "for_each" of a study, in each of its forms.
#include <arcslip/scene/keys/csv_text.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace arcslip::scene::file {
namespace {

/// The rows of a CSV file, whose header has the names of parameters, with their units behind them or without.
class RowsFile {
 public:
  RowsFile(const Location& place, const NamedFile& file, const Reading& reading,
           const std::vector<ParameterUse>& taken)
      : place_(place), file_(file), reading_(reading), taken_(taken) {}

  ValueLists read() {
    bool is_header = true;
    for_each_line(*file_.text, [&](std::size_t number, const auto& cells, std::string_view) {
      number_ = number;
      if (!is_header) return read_row(cells);
      is_header = false;
      const std::size_t before = reading_.faults.count();
      for (const std::string_view cell : cells) read_title(trimmed(cell));
      return reading_.faults.count() == before;
    });
    if (!is_faulty_ && (is_header || lists_.front().second.empty()))
      reading_.faults.add(
          place_.pointer,
          "found no rows in " + shown(file_.path) +
              ", must be a header with names of parameters, and a value of each on every line");
    return std::move(lists_);
  }

 private:
  void fault(const std::string& what) {
    is_faulty_ = true;
    if (reading_.faults.full()) return reading_.faults.add({}, {});
    reading_.faults.add(place_.pointer,
                        "line " + std::to_string(number_) + " of " + shown(file_.path) + ": " + what);
  }

  /// A title: "damper.normal_load" or "damper.normal_load (N)".
  void read_title(std::string_view title) {
    const std::size_t bracket = title.find(" (");
    std::string name(trimmed(title.substr(0, bracket)));
    const std::size_t before = reading_.faults.count();
    const Field bounds = bounds_of(name, place_.pointer, reading_.parameters, reading_.faults);
    is_taken(name, place_.pointer, taken_, reading_.faults);
    is_faulty_ = is_faulty_ || reading_.faults.count() > before;
    if (bracket != std::string_view::npos && !bounds.unit.empty() &&
        title.substr(bracket) != " (" + std::string(bounds.unit) + ")")
      fault("found the title " + shown(title) + ", must be " +
            shown(name + " (" + std::string(bounds.unit) + ")") + ": numbers have the units of the scene");
    if (std::any_of(lists_.begin(), lists_.end(), [&](const auto& list) { return list.first == name; }))
      fault("found the title " + shown(name) + " again, must stand only once");
    bounds_.push_back(bounds);
    lists_.emplace_back(name, std::vector<double>());
  }

  template <class Cells>
  bool read_row(const Cells& cells) {
    if (cells.size() != lists_.size()) {
      fault("found " + std::to_string(cells.size()) + " values, must be " + std::to_string(lists_.size()) +
            ", as the header has");
      return true;
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const std::string_view text = trimmed(cells[k]);
      double value = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        fault("found " + shown(text) + ", must be a finite number");
      else if (!within(bounds_[k], value))
        fault(bound_fault(bounds_[k], value));
      lists_[k].second.push_back(value);
    }
    return true;
  }

  const Location& place_;
  const NamedFile& file_;
  const Reading& reading_;
  const std::vector<ParameterUse>& taken_;
  std::size_t number_ = 0;
  bool is_faulty_ = false;
  ValueLists lists_;
  std::vector<Field> bounds_;
};

}  // namespace

void read_for_each(const Location& place, const Reading& reading, const std::vector<ParameterUse>& taken,
                   Study& study) {
  if (are_samples(place, reading.parameters)) {
    study.samples = read_samples(place, reading.parameters, taken, reading.faults);
  } else if (place.node != nullptr && place.node->get<std::string>() != nullptr) {
    const auto file = read_file_of(place, "the path of a CSV file of samples", reading);
    if (!file) return;
    study.for_each = RowsFile(place, *file, reading, taken).read();
    study.in_rows = !study.for_each.empty();
    study.rows_file = *file;
  } else if (const Node::List* list = place.node != nullptr ? place.node->get<Node::List>() : nullptr) {
    study.for_each = read_rows(place, *list, reading.parameters, taken, reading.faults);
    study.in_rows = !study.for_each.empty();
  } else {
    study.for_each = read_value_lists(place, reading.parameters, taken, reading.faults);
  }
}

}  // namespace arcslip::scene::file
