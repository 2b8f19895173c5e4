#include "values.hpp"

#include <nanobind/ndarray.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace nb = nanobind;

namespace arcslip::python {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// A read-only array.
template <class T>
using Array = nb::ndarray<nb::numpy, const T, nb::ndim<1>>;

/// An array that shares memory, which `owner` keeps.
template <class T>
nb::object shared(const std::vector<T>& values, nb::handle owner) {
  static constexpr T none{};
  return nb::cast(Array<T>(values.empty() ? &none : values.data(), {values.size()}, owner));
}

/// An array that owns its values.
template <class T>
nb::object owned(std::unique_ptr<T[]> values, std::size_t count) {
  const nb::capsule owner(values.get(), [](void* of) noexcept { std::unique_ptr<T[]>(static_cast<T*>(of)); });
  const T* first = values.release();
  return nb::cast(Array<T>(first, {count}, owner));
}

template <class T, class List>
nb::object copied(const List& list) {
  auto values = std::make_unique<T[]>(list.size());
  std::copy(list.begin(), list.end(), values.get());
  return owned(std::move(values), list.size());
}

bool is_absent(const results::Cells& cells, std::size_t i) {
  return !cells.absent.empty() && cells.absent[i];
}

/// Whole numbers or flags as numbers, with NaN where they are missing.
template <class List>
nb::object with_missing(const results::Cells& cells, const List& list) {
  auto values = std::make_unique<double[]>(list.size());
  for (std::size_t i = 0; i < list.size(); ++i)
    values[i] = is_absent(cells, i) ? missing : static_cast<double>(list[i]);
  return owned(std::move(values), list.size());
}

nb::object as_object(bool flag) {
  return nb::bool_(flag);
}
nb::object as_object(long number) {
  return nb::int_(number);
}
nb::object as_object(const std::string& text) {
  return nb::str(text.data(), text.size());
}
nb::object as_object(double number) {
  return std::isfinite(number) ? nb::object(nb::float_(number)) : nb::none();
}

nb::object as_object(const results::Value::Numbers& numbers) {
  auto values = std::make_unique<double[]>(numbers.size());
  std::transform(numbers.begin(), numbers.end(), values.get(),
                 [](double number) { return std::isfinite(number) ? number : missing; });
  return owned(std::move(values), numbers.size());
}

}  // namespace

nb::object as_object(const results::Value& value) {
  return std::visit(
      [](const auto& is) -> nb::object {
        using Is = std::decay_t<decltype(is)>;
        if constexpr (std::is_same_v<Is, std::nullptr_t>) {
          return nb::none();
        } else if constexpr (std::is_same_v<Is, results::Value::List>) {
          nb::list all;
          for (const results::Value& each : is) all.append(as_object(each));
          return all;
        } else if constexpr (std::is_same_v<Is, results::Object>) {
          return as_dict(is);
        } else {
          return as_object(is);
        }
      },
      value.get());
}

nb::dict as_dict(const results::Object& object) {
  nb::dict all;
  for (const results::Member& member : object) all[member.key.c_str()] = as_object(member.value);
  return all;
}

void mark_missing(results::Rows& rows) {
  for (results::Cells& cells : rows.columns)
    if (auto* numbers = std::get_if<std::vector<double>>(&cells.of))
      for (std::size_t i = 0; i < numbers->size(); ++i)
        if (is_absent(cells, i) || !std::isfinite((*numbers)[i])) (*numbers)[i] = missing;
}

nb::object as_column(const results::Cells& cells, nb::handle owner) {
  const bool whole = std::find(cells.absent.begin(), cells.absent.end(), true) == cells.absent.end();
  return std::visit(
      [&](const auto& list) -> nb::object {
        using Cell = typename std::decay_t<decltype(list)>::value_type;
        if constexpr (std::is_same_v<Cell, double>) {
          return shared(list, owner);
        } else if constexpr (std::is_same_v<Cell, long>) {
          return whole ? shared(list, owner) : with_missing(cells, list);
        } else if constexpr (std::is_same_v<Cell, bool>) {
          return whole ? copied<bool>(list) : with_missing(cells, list);
        } else {
          nb::list all;
          for (std::size_t i = 0; i < list.size(); ++i)
            all.append(is_absent(cells, i) ? nb::none() : as_object(list[i]));
          return all;
        }
      },
      cells.of);
}

}  // namespace arcslip::python
