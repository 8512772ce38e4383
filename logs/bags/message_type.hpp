#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace touchdown::logs {

/// The numbers of a message of any type, in the order of their definition.
struct MessageNumbers {
  std::vector<double> values;
  std::vector<std::string> paths;      ///< of each: "motor_state[0].tau_est"
  std::vector<std::uint32_t> lengths;  ///< of the lists without a fixed length; the paths depend on
                                       ///< nothing else
};

/// A type of messages, by the definition that a bag carries. It decodes numbers and flags; texts
/// are skipped, and so are lists of more than 1024 numbers, such as images.
class MessageType {
 public:
  /// `definition` is that of ROS 2's .msg files, followed by those of the types that it uses, each
  /// behind a line of "=" and a line "MSG: package/Type". Errors: `InputError` that names the line
  /// for a definition that is another one, is missing, or contains itself.
  MessageType(const std::string& name, std::string_view definition);

  /// Decodes a message's payload in CDR. Errors: `InputError` for a malformed payload.
  void decode(std::string_view payload, MessageNumbers& numbers) const;

 private:
  friend class TypeParser;
  friend class NumberReader;

  enum class Array { none, fixed, sequence };
  struct Field {
    std::string name;
    std::size_t type = 0;  ///< a primitive type, or behind them one of `structs_`
    Array array = Array::none;
    std::size_t length = 0;  ///< of a fixed array
  };
  using Struct = std::vector<Field>;

  std::vector<Struct> structs_;
};

}  // namespace touchdown::logs
