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

  Value();
  Value(bool flag);
  template <class Whole, std::enable_if_t<std::is_integral_v<Whole> && !std::is_same_v<Whole, bool>, int> = 0>
  Value(Whole number) : Value(static_cast<long>(number), OneType{}) {}
  Value(double number);
  Value(const char* text);
  Value(std::string_view text);
  Value(std::string text);
  Value(Numbers numbers);
  Value(List list);
  Value(Object object);
  Value(const Value& other);
  Value(Value&& other) noexcept;
  Value& operator=(const Value& other);
  Value& operator=(Value&& other) noexcept;
  ~Value();

  const auto& get() const { return is_; }
  /// Of an object.
  Object& members();

 private:
  struct OneType {};
  Value(long number, OneType);

  std::variant<std::nullptr_t, bool, long, double, std::string, Numbers, List, Object> is_;
};

struct Member {
  std::string key;
  Value value;
  std::string unit{};  // of a number
};

using Object = Value::Object;

}  // namespace arcslip::results
