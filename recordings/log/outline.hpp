#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace touchdown::recordings {

/// The keys of `observation` under which beliefs are logged.
inline constexpr std::array<std::string_view, 3> belief_groups = {
    "measurement_model", "transition_model", "contact_filter"};

/// Where the `observation` map stands in the bytes of a record, so that beliefs can be written into
/// it without taking the record apart again.
struct ObservationOutline {
  struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  /// Offset of the map's header; 0 if the record has no such map.
  std::size_t header = 0;
  /// How many entries the map has.
  std::size_t entries = 0;
  /// Entries that are beliefs already, key and value, in their order.
  std::vector<Range> beliefs;
};

/// Of a record, a MessagePack map with keys of any kind; of several maps called `observation`, the
/// last. Errors: `InputError` when the record is cut off.
ObservationOutline outline_of(std::string_view record);

}  // namespace touchdown::recordings
