#pragma once
// A table of items of one kind: its columns, each with its getter, in one place.
//
//   TableOf<Peak> peaks;
//   peaks.add({"frequency"}, "Hz", "where it is", [](const Peak& peak) { return peak.frequency; });
//   schema.tables = {{"peaks", peaks.columns()}};   sink.rows(0, peaks.rows(all));

#include <arcslip/results/result.hpp>

#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace arcslip::results {
namespace detail {

template <class T>
struct Optional {
  using Value = T;
  static constexpr bool is = false;
};

template <class T>
struct Optional<std::optional<T>> {
  using Value = T;
  static constexpr bool is = true;
};

/// The alternative of Cells for values of type T.
template <class T>
constexpr Type type_of() {
  if constexpr (std::is_same_v<T, bool>)
    return Type::flag;
  else if constexpr (std::is_floating_point_v<T>)
    return Type::number;
  else if constexpr (std::is_integral_v<T>)
    return Type::whole;
  else if constexpr (std::is_convertible_v<T, std::string>)
    return Type::text;
  else
    return Type::value;
}

}  // namespace detail

template <class Item>
class TableOf {
 public:
  using Items = std::span<const Item* const>;

  /// get(item): a number, a flag, a text or anything a Value is made of; or std::optional of one, empty if
  /// the item does not have it.
  template <class Get>
  void add(std::vector<std::string> path, std::string unit, std::string help, Get get) {
    using Got = std::decay_t<std::invoke_result_t<Get, const Item&>>;
    constexpr Type type = detail::type_of<typename detail::Optional<Got>::Value>();
    columns_.push_back({std::move(path), type, std::move(unit), std::move(help)});
    fill_.push_back(filler<Got>(std::move(get)));
  }

  /// The columns of a part of the item, behind keys of their own. get(item): a pointer to the part; null: the
  /// item does not have it.
  template <class Part, class Get>
  void add(const TableOf<Part>& part, Get get, const std::vector<std::string>& prefix = {}) {
    for (std::size_t c = 0; c < part.columns_.size(); ++c) {
      columns_.push_back(part.columns_[c]);
      columns_.back().path.insert(columns_.back().path.begin(), prefix.begin(), prefix.end());
      fill_.push_back([get, fill = part.fill_[c]](Items items) {
        std::vector<const Part*> parts;
        std::vector<bool> absent;
        for (const Item* item : items) {
          if (const Part* of = get(*item)) parts.push_back(of);
          absent.push_back(!get(*item));
        }
        return parts.size() == items.size() ? fill(parts) : spread(fill(parts), absent);
      });
    }
  }

  const std::vector<Column>& columns() const { return columns_; }

  /// The columns from this one on are details (Column::is_detail).
  void set_details(std::size_t first) {
    for (std::size_t c = first; c < columns_.size(); ++c) columns_[c].is_detail = true;
  }

  Rows rows(Items items) const {
    Rows rows{items.size(), {}};
    for (const auto& fill : fill_) rows.columns.push_back(fill(items));
    return rows;
  }

  /// Of a range of items.
  template <class Range>
    requires std::is_same_v<std::decay_t<decltype(*std::begin(std::declval<const Range&>()))>, Item>
  Rows rows(const Range& range) const {
    std::vector<const Item*> items;
    for (const Item& item : range) items.push_back(&item);
    return rows(Items(items));
  }

 private:
  template <class Other>
  friend class TableOf;

  // Compiled once for all columns of a type.
  template <class Got>
  static std::function<Cells(Items)> filler(std::function<Got(const Item&)> get) {
    return [get = std::move(get)](Items items) { return cells<Got>(items, get); };
  }

  template <class Got>
  static Cells cells(Items items, const std::function<Got(const Item&)>& get) {
    constexpr auto index = static_cast<std::size_t>(detail::type_of<typename detail::Optional<Got>::Value>());
    Cells cells{decltype(Cells::of)(std::in_place_index<index>)};
    auto& list = std::get<index>(cells.of);
    using Cell = typename std::decay_t<decltype(list)>::value_type;
    list.reserve(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
      if constexpr (detail::Optional<Got>::is) {
        auto got = get(*items[i]);
        if (!got && cells.absent.empty()) cells.absent.assign(items.size(), false);
        if (!got) cells.absent[i] = true;
        list.push_back(got ? static_cast<Cell>(*std::move(got)) : Cell());
      } else {
        list.push_back(static_cast<Cell>(get(*items[i])));
      }
    }
    return cells;
  }

  /// The cells of some items among absent ones.
  static Cells spread(Cells some, const std::vector<bool>& absent) {
    std::visit(
        [&](auto& list) {
          std::decay_t<decltype(list)> all(absent.size());
          std::vector<bool> none = absent;
          for (std::size_t i = 0, next = 0; i < absent.size(); ++i) {
            if (absent[i]) continue;
            none[i] = !some.absent.empty() && some.absent[next];
            all[i] = list[next++];
          }
          list = std::move(all);
          some.absent = std::move(none);
        },
        some.of);
    return some;
  }

  std::vector<Column> columns_;
  std::vector<std::function<Cells(Items)>> fill_;
};

}  // namespace arcslip::results
