#pragma once
// Data that the monitors of one trace keep between calls, such as a spectrum shared by several of them. It
// belongs to the trace, so that monitors have no mutable state and copies of them may serve traces in
// several threads.

#include <memory>
#include <typeindex>
#include <utility>
#include <vector>

namespace arcslip::continuation {

class Scratch {
 public:
  Scratch() = default;
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  /// The single object of this type, created as T{} at the first request. Another monitor may have set it at
  /// another point of the branch: check what it refers to before use.
  template <class T>
  T& get() {
    for (const auto& [type, kept] : all_)
      if (type == typeid(T)) return *static_cast<T*>(kept.get());
    auto made = std::make_shared<T>();
    all_.emplace_back(typeid(T), made);
    return *made;
  }

 private:
  std::vector<std::pair<std::type_index, std::shared_ptr<void>>> all_;
};

}  // namespace arcslip::continuation
