#pragma once

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"

namespace touchdown {

/// The message of the error that an action throws; "no complaint" if it throws none.
template <typename Kind = InputError, typename Action>
std::string complaint_of(const Action& action) {
  try {
    action();
  } catch (const Kind& error) {
    return error.what();
  }
  return "no complaint";
}

/// An input that is refused, and the words of the complaint: its place, its key, what was expected.
/// Words after '^' are its beginning.
struct Refusal {
  std::string input;
  std::vector<std::string> words;
};

/// Checks that `read` refuses every input with a complaint of one line that has all of its words.
template <typename Read>
void expect_refused(const std::vector<Refusal>& table, const Read& read) {
  for (const Refusal& refusal : table) {
    const std::string& input = refusal.input;
    const std::string complaint = complaint_of([&] { (void)read(input); });
    EXPECT_NE(complaint, "no complaint") << input;
    EXPECT_THAT(complaint, ::testing::Not(::testing::HasSubstr("\n"))) << input;
    for (const std::string& word : refusal.words) {
      if (word.starts_with('^')) {
        EXPECT_THAT(complaint, ::testing::StartsWith(word.substr(1))) << input;
      } else {
        EXPECT_THAT(complaint, ::testing::HasSubstr(word)) << input;
      }
    }
  }
}

}  // namespace touchdown
