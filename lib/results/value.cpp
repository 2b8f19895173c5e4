#include <arcslip/results/value.hpp>

namespace arcslip::results {

// A list of members is complete only here: no constructor, and nothing that destroys one, is inline.

Value::Value() : is_(nullptr) {}
Value::Value(bool flag) : is_(flag) {}
Value::Value(long number, OneType) : is_(number) {}
Value::Value(double number) : is_(number) {}
Value::Value(const char* text) : is_(std::string(text)) {}
Value::Value(std::string_view text) : is_(std::string(text)) {}
Value::Value(std::string text) : is_(std::move(text)) {}
Value::Value(Numbers numbers) : is_(std::move(numbers)) {}
Value::Value(List list) : is_(std::move(list)) {}
Value::Value(Object object) : is_(std::move(object)) {}
Value::Value(const Value& other) = default;
Value::Value(Value&& other) noexcept = default;
Value& Value::operator=(const Value& other) = default;
Value& Value::operator=(Value&& other) noexcept = default;
Value::~Value() = default;

Object& Value::members() {
  return std::get<Object>(is_);
}

}  // namespace arcslip::results
