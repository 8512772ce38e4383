#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "models/robot.hpp"

namespace touchdown::recordings {

/// What an estimator that is none of ours said about a run, step by step.
struct Beliefs {
  std::string file;
  std::vector<double> time;       ///< s, increasing
  std::vector<std::size_t> line;  ///< of the file, where it has lines
  /// Left wheel, right wheel: probability, and decision (p ≥ 0.5 where it made none).
  std::array<std::vector<double>, models::wheel_count> p_contact;
  std::array<std::vector<std::uint8_t>, models::wheel_count> contact;

  std::size_t size() const { return time.size(); }
  /// Where a belief stands, for complaints: "beliefs.csv:12", "beliefs.npz: belief 11".
  std::string place(std::size_t index) const;
};

/// What is wrong with the names or with one row of a file, and in which column; who reads the file
/// knows where that is.
struct WrongBelief {
  std::size_t column = 0;
  std::string what;
};

/// Columns of any format: `time`, `p_left`, `p_right`, and both or none of `contact_left` and
/// `contact_right`, in any order.
class BeliefColumns {
 public:
  /// The file's names in their order. Nothing if they are right.
  std::optional<WrongBelief> set_names(std::span<const std::string> names);
  /// One step, its values in the order of the names; it is taken unless something is wrong.
  std::optional<WrongBelief> add(std::span<const double> values);

  /// What was taken so far.
  Beliefs beliefs;

 private:
  std::vector<std::string> names_;
  std::array<std::size_t, 5> column_{};  ///< of each known name
  bool decides_ = false;
};

}  // namespace touchdown::recordings
