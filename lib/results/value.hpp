#pragma once
// A value of any shape: facts of a result in addition to its tables, such as a certificate or the cost.

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace arcslip::results {

struct Member;

/// Nothing, a flag, a whole number, a number, a text, a list of numbers, a list of values, or members by
/// name.
class Value {
 public:
  using Numbers = std::vector<double>;
  using List = std::vector<Value>;
  using Object = std::vector<Member>;

  Value() = default;
  Value(bool flag) : is_(flag) {}
  template <class Whole, std::enable_if_t<std::is_integral_v<Whole> && !std::is_same_v<Whole, bool>, int> = 0>
  Value(Whole number) : is_(static_cast<long>(number)) {}
  Value(double number) : is_(number) {}
  Value(const char* text) : is_(std::string(text)) {}
  Value(std::string_view text) : is_(std::string(text)) {}
  Value(std::string text) : is_(std::move(text)) {}
  Value(Numbers numbers) : is_(std::move(numbers)) {}
  Value(List list) : is_(std::move(list)) {}
  Value(Object object) : is_(std::move(object)) {}

  const auto& get() const { return is_; }
  /// Of an object.
  Object& members() { return std::get<Object>(is_); }

 private:
  std::variant<std::nullptr_t, bool, long, double, std::string, Numbers, List, Object> is_ = nullptr;
};

struct Member {
  std::string key;
  Value value;
  std::string unit{};  // of a number
};

using Object = Value::Object;

}  // namespace arcslip::results
