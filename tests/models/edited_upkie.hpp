#pragma once

#include <regex>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/files.hpp"
#include "tests/models/upkie_mjcf.hpp"

namespace touchdown {

/// A pattern in Upkie's MJCF, and its replacement.
using Edit = std::pair<std::string, std::string>;

/// Upkie's MJCF with all matches of each pattern replaced, one edit after the other.
inline std::string edited_upkie(const std::vector<Edit>& edits) {
  std::string text = read_file(upkie_mjcf);
  for (const auto& [pattern, by] : edits) {
    const std::regex expression(pattern);
    EXPECT_TRUE(std::regex_search(text, expression)) << pattern;
    text = std::regex_replace(text, expression, by);
  }
  return text;
}

/// Elements that are added before the end of the MJCF.
inline Edit added(const std::string& elements) { return {"</mujoco>", elements + "</mujoco>"}; }

}  // namespace touchdown
