#pragma once
// What the monitors of one trace keep between their calls, as a spectrum that several of them read. It
// belongs to the trace, so that monitors hold nothing that changes: copies of them serve traces in several
// threads.

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

  /// The one object of this type, made by T{} when it is first asked for. Others may have used it at other
  /// places of the branch: what it holds is to be compared with where it is asked for.
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
