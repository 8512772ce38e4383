#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/fault_preload/plan.hpp"

namespace touchdown::faults {

constexpr std::uint32_t bit(Kind kind) { return 1U << static_cast<unsigned>(kind); }
/// All kinds of calls on files.
constexpr std::uint32_t all_files = bit(Kind::allocation) - 1;

/// A plan of faults for a program that runs below `root`, and for its child processes.
class Injection {
 public:
  explicit Injection(const std::filesystem::path& root);
  Injection(const Injection&) = delete;
  Injection& operator=(const Injection&) = delete;
  ~Injection();

  Plan& operator*() const { return *plan_; }
  Plan* operator->() const { return plan_; }
  /// Environment variables for the program.
  std::vector<std::string> environment() const;
  /// Names of the first refused files, or "memory"; an error message must contain one of them. For
  /// a partial file, it is the final name.
  std::vector<std::string> subjects() const;
  bool has_refused(Kind kind) const;

 private:
  std::filesystem::path file_;
  Plan* plan_ = nullptr;
};

}  // namespace touchdown::faults
