#include "core/keys/key_collection.hpp"

#include <algorithm>

namespace touchdown {

std::size_t KeyCollection::add(Key key) {
  if (required_.contains(key.path)) key.fallback = "required";
  keys_.push_back(std::move(key));
  return keys_.size() - 1;
}

std::string KeyCollection::path_of_open(std::type_index item) const {
  const auto found = std::find_if(open_.begin(), open_.end(),
                                  [&](const auto& list) { return list.first == item; });
  return found == open_.end() ? "" : found->second;
}

const KeyNotes& KeyNotes::doc(std::string_view unit, std::string_view meaning) const {
  set(&Key::unit, unit);
  return doc(meaning);
}

const KeyNotes& KeyNotes::set(std::string Key::*member, std::string_view text) const {
  if (keys_ != nullptr) (*keys_)[index_].*member = text;
  return *this;
}

}  // namespace touchdown
