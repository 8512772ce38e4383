#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/table.hpp"

namespace touchdown::logs {

/// What is implausible about a log: one line per finding. Subjects with the same finding share its
/// line: "left_knee, right_knee: torque is 0 throughout".
class Findings {
 public:
  void add(std::string_view subject, const std::string& finding);

  /// In the order in which the findings were added.
  std::vector<std::string> lines() const;

 private:
  struct Finding {
    std::string text;
    std::vector<std::string> subjects;
  };
  std::vector<Finding> findings_;
};

}  // namespace touchdown::logs
