#pragma once

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace touchdown::fuzz {

/// Whether a message is a text of the standard library, or of a library that reads a format. A user
/// cannot know what it is about. What the message quotes from `input` does not count.
inline bool is_of_a_library(std::string_view message, std::string_view input = {}) {
  for (const std::string_view text :
       {"bad_cast", "bad_alloc", "std::", "json.exception", "yaml-cpp", "bad conversion",
        "invalid node", "filesystem error", "basic_string", "vector::", "map::at", "stod",
        "insufficient bytes", "regex_error"}) {
    if (input.find(text) != std::string_view::npos) continue;
    if (message.find(text) != std::string_view::npos) return true;
  }
  return message.empty();
}

/// An expected error. Its message must be touchdown's own.
inline void expected(const Error& error, std::string_view input) {
  if (is_of_a_library(error.what(), input)) std::abort();
}

/// A fuzzed function, by the name of its folder in the corpus.
struct Target {
  const char* name;
  void (*fuzz)(std::string_view input);
};

/// Calls the function. An `Error` is expected.
inline void call(const Target& target, std::string_view input) {
  try {
    target.fuzz(input);
  } catch (const Error& error) {
    expected(error, input);
  }
}

/// All fuzzed functions of this program.
inline std::vector<Target>& targets() {
  static std::vector<Target> all;
  return all;
}

}  // namespace touchdown::fuzz

/// Begins the definition of a fuzzed function of `std::string_view input`. For any input, it must
/// not crash, hang, or throw anything but `touchdown::Error` with a message of touchdown's own.
#define TOUCHDOWN_FUZZ(name)                             \
  static void fuzz_##name(std::string_view input);       \
  [[maybe_unused]] static const bool is_target_##name =  \
      (targets().push_back({#name, fuzz_##name}), true); \
  static void fuzz_##name(std::string_view input)
