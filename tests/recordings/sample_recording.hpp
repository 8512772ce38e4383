#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include "recordings/recording.hpp"

namespace touchdown::testing {

/// A recording in which no two numbers are equal, with the odd ones (NaN, infinities, negative
/// zero, denormals) in between.
Recording sample_recording(std::size_t steps, bool with_truth = true);

/// A Python interpreter that has NumPy, or empty.
std::string python_with_numpy();

/// A folder that disappears with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            (std::string("touchdown-") + test->test_suite_name() + "-" + test->name() + "-" +
             std::to_string(::getpid()));
    std::filesystem::create_directories(path_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace touchdown::testing
