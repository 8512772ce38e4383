#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace touchdown::recordings {

/// The columns of a sensor_msgs/JointState in a CSV file, as programs write its lists: name[0],
/// position[0], velocity[0], effort[0], name[1], … A joint is found by the name in its row, as in a
/// bag: as a column NAME/position, NAME/velocity or NAME/effort.
class JointColumns {
 public:
  /// The lists among these columns, if there is one of names. Before a list's name there may be
  /// those of its message (field.name0); its index may be in brackets, or behind a dot, a slash or
  /// an underscore.
  static std::optional<JointColumns> among(std::span<const std::string> columns);

  bool is_name(std::size_t column) const;
  bool is_number(std::size_t column) const;

  /// Sets the text of a column of names in the present row.
  void set_name(std::size_t column, std::string_view name);
  /// The columns that the joints of the present row have, by name.
  std::vector<std::string> names() const;
  /// Where the number of a joint's column is in the present row; nothing if the row lacks it.
  std::optional<std::size_t> column_of(std::string_view joint_column) const;

 private:
  struct Joint {
    std::size_t name_column = 0;
    std::array<std::optional<std::size_t>, 3> numbers;  ///< position, velocity, effort
    std::string name;                                   ///< in the present row
  };
  std::vector<Joint> joints_;
};

}  // namespace touchdown::recordings
