#include "core/keys/repeats.hpp"

#include <algorithm>
#include <span>

namespace touchdown {

namespace {

constexpr std::size_t short_section = 2;  ///< as long as a reference to another section

/// The keys below key `i`, which follow it.
std::span<const Key> below(const std::vector<Key>& keys, std::size_t i) {
  const std::string& path = keys[i].path;
  std::size_t end = i + 1;
  while (end < keys.size() &&
         (keys[end].path.starts_with(path + ".") || keys[end].path.starts_with(path + "[]."))) {
    ++end;
  }
  return std::span(keys).subspan(i + 1, end - i - 1);
}

/// The key as its section has it, wherever the section is.
Key relative(Key key, const std::string& section) {
  key.path.erase(0, section.size());
  if (key.type.ends_with(" as " + section)) key.type.resize(key.type.size() - section.size());
  return key;
}

bool are_equal(std::span<const Key> keys, const std::string& section, std::span<const Key> others,
               const std::string& other_section) {
  return std::equal(keys.begin(), keys.end(), others.begin(), others.end(),
                    [&](const Key& key, const Key& other) {
                      return relative(key, section) == relative(other, other_section);
                    });
}

}  // namespace

std::vector<Key> without_repeats(const std::vector<Key>& keys) {
  std::vector<Key> kept;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    Key& key = kept.emplace_back(keys[i]);
    const std::span<const Key> inner = below(keys, i);
    if (inner.size() <= short_section) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (!are_equal(inner, key.path, below(keys, j), keys[j].path)) continue;
      key.type += " as " + keys[j].path;
      i += inner.size();
      break;
    }
  }
  return kept;
}

}  // namespace touchdown
