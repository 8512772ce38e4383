#pragma once

#include <any>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace palimpsest {

/// The part of Upkie's dictionaries that observers use, for tests: a value, or dictionaries by name.
class Dictionary {
 public:
  bool has(const std::string& key) const noexcept { return children_.count(key) > 0; }

  /// Creates the child if it does not exist.
  Dictionary& operator()(const std::string& key) {
    std::unique_ptr<Dictionary>& child = children_[key];
    if (child == nullptr) child = std::make_unique<Dictionary>();
    return *child;
  }
  /// Throws if the child does not exist.
  const Dictionary& operator()(const std::string& key) const {
    const auto found = children_.find(key);
    if (found == children_.end()) throw std::out_of_range("no key " + key);
    return *found->second;
  }

  /// Throws if the value has another type.
  template <typename T>
  const T& as() const {
    const T* const value = std::any_cast<T>(&value_);
    if (value == nullptr) throw std::runtime_error("another type");
    return *value;
  }
  template <typename T>
  const T& get(const std::string& key) const {
    return (*this)(key).template as<T>();
  }

  /// A value keeps its type: throws for a value of another type.
  template <typename T>
  Dictionary& operator=(const T& value) {
    if (value_.has_value()) static_cast<void>(as<T>());
    value_ = value;
    return *this;
  }

 private:
  std::any value_;
  std::map<std::string, std::unique_ptr<Dictionary>> children_;
};

}  // namespace palimpsest
