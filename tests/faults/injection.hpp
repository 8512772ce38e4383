#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/fault_preload/plan.hpp"

namespace touchdown::faults {

constexpr std::uint32_t bit(Kind kind) { return 1U << static_cast<unsigned>(kind); }
/// Whatever goes to files.
constexpr std::uint32_t all_files = bit(Kind::allocation) - 1;

/// A plan of what goes wrong in one program that is started below `root`, and in what it starts.
class Injection {
 public:
  explicit Injection(const std::filesystem::path& root);
  Injection(const Injection&) = delete;
  Injection& operator=(const Injection&) = delete;
  ~Injection();

  Plan& operator*() const { return *plan_; }
  Plan* operator->() const { return plan_; }
  /// What the program needs in its environment.
  std::vector<std::string> environment() const;
  /// Names of what was refused first, one of which a complaint has to hold: a file's own one, if it
  /// is a part of it that could not be written.
  std::vector<std::string> subjects() const;
  bool has_refused(Kind kind) const;

 private:
  std::filesystem::path file_;
  Plan* plan_ = nullptr;
};

}  // namespace touchdown::faults
