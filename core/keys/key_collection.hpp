#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <typeindex>
#include <utility>
#include <vector>

#include "core/keys/key.hpp"

namespace touchdown {

/// The keys of one kind of file, in the order of their description (core/fields.hpp).
class KeyCollection {
 public:
  /// Adds a key and returns its index. The fallback of a required key is "required".
  std::size_t add(Key key);
  /// Marks a key that is added later as required.
  void require(std::string path) { required_.insert(std::move(path)); }

  Key& operator[](std::size_t index) { return keys_[index]; }
  const std::vector<Key>& keys() const { return keys_; }

  /// Begins and ends the description of the items of a list. Lists that may contain lists of the
  /// same items are described once.
  void open(std::type_index item, std::string path) { open_.emplace_back(item, std::move(path)); }
  void close() { open_.pop_back(); }
  /// The path of the open list with these items; empty if there is none.
  std::string path_of_open(std::type_index item) const;

 private:
  std::vector<Key> keys_;
  std::set<std::string> required_;
  std::vector<std::pair<std::type_index, std::string>> open_;
};

/// Completes the documentation of one key. Without effect when a file is read or written.
class KeyNotes {
 public:
  KeyNotes() = default;
  KeyNotes(KeyCollection& keys, std::size_t index) : keys_(&keys), index_(index) {}

  /// The key's meaning in one sentence, with the unit of its value.
  const KeyNotes& doc(std::string_view unit, std::string_view meaning) const;
  const KeyNotes& doc(std::string_view meaning) const { return set(&Key::meaning, meaning); }

  // Texts instead of those that follow from the description.
  const KeyNotes& type(std::string_view text) const { return set(&Key::type, text); }
  const KeyNotes& range(std::string_view text) const { return set(&Key::range, text); }
  const KeyNotes& fallback(std::string_view text) const { return set(&Key::fallback, text); }

 private:
  const KeyNotes& set(std::string Key::*member, std::string_view text) const;

  KeyCollection* keys_ = nullptr;
  std::size_t index_ = 0;
};

}  // namespace touchdown
