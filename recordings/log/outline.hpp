#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace touchdown::recordings {

/// The keys of `observation` under which beliefs are logged.
inline constexpr std::array<std::string_view, 3> belief_groups = {
    "measurement_model", "transition_model", "contact_filter"};

/// Position of the `observation` map in the bytes of a record. With it, beliefs can be inserted
/// without decoding the record.
struct ObservationOutline {
  struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  /// Offset of the map's header; 0 if the record has no such map.
  std::size_t header = 0;
  /// Number of entries of the map.
  std::size_t entries = 0;
  /// Existing beliefs, each from its key to the end of its value, in order.
  std::vector<Range> beliefs;
};

/// Finds the outline of a record, a MessagePack map with keys of any type. If there are several
/// maps called `observation`, the last one counts. Errors: `InputError` when the record is cut off.
ObservationOutline outline_of(std::string_view record);

}  // namespace touchdown::recordings
