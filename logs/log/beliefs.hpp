#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "models/robot.hpp"

namespace touchdown::logs {

/// The beliefs of an external estimator about a run, step by step.
struct Beliefs {
  std::string file;
  std::vector<double> time;       ///< s, increasing
  std::vector<std::size_t> line;  ///< of the file, if it has lines
  /// Left, right: probability of contact, and decision (p ≥ 0.5 if the file has no decisions).
  std::array<std::vector<double>, models::wheel_count> p_contact;
  std::array<std::vector<std::uint8_t>, models::wheel_count> contact;

  std::size_t size() const { return time.size(); }
  /// Position of a belief for messages: "beliefs.csv:12", "beliefs.npz: belief 11".
  std::string place(std::size_t index) const;
};

/// Reads beliefs as comma-separated values: a line of names, then a line per step. Decisions are 1
/// and 0 or true and false. Errors: `InputError` with file:line:column.
Beliefs read_belief_csv(const std::filesystem::path& path);

/// Reads beliefs as NumPy's arrays, one per name and of equal length. Errors: `InputError` that
/// names the file, the array and the index.
Beliefs read_belief_npz(const std::filesystem::path& path);

/// Reads beliefs as a sequence of MessagePack dictionaries, like Upkie's logs: one per step, with
/// numbers (decisions also as booleans) by name. Errors: `InputError` that names the file and the
/// dictionary, counted from 0.
Beliefs read_belief_mpack(const std::filesystem::path& path);

/// Reads a belief file by its extension. Errors: `InputError` with the position and what was
/// expected.
Beliefs read_beliefs(const std::filesystem::path& path);

}  // namespace touchdown::logs
