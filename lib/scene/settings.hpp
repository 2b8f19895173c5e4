#pragma once

#include <any>
#include <utility>

namespace arcslip::scene {

/// The settings of a kind of study, of a type known only to that kind. Compares by value.
class Settings {
 public:
  Settings() = default;

  template <class T>
  static Settings of(T value) {
    Settings settings;
    settings.value_ = std::move(value);
    settings.equal_ = [](const std::any& a, const std::any& b) {
      return std::any_cast<const T&>(a) == std::any_cast<const T&>(b);
    };
    return settings;
  }

  bool empty() const { return !value_.has_value(); }

  /// Throws std::bad_any_cast for another type.
  template <class T>
  const T& as() const {
    return std::any_cast<const T&>(value_);
  }
  template <class T>
  T& as() {
    return std::any_cast<T&>(value_);
  }

  friend bool operator==(const Settings& a, const Settings& b) {
    return a.value_.type() == b.value_.type() && (!a.value_.has_value() || a.equal_(a.value_, b.value_));
  }

 private:
  std::any value_;
  bool (*equal_)(const std::any&, const std::any&) = nullptr;
};

}  // namespace arcslip::scene
