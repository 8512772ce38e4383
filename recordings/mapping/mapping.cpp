#include "recordings/mapping/mapping.hpp"

namespace touchdown::recordings {

std::size_t LogMapping::joint_source() const {
  for (const MappedSignal::Number& number : position.numbers) {
    if (number.column < columns.size()) return columns[number.column].source;
  }
  return 0;
}

}  // namespace touchdown::recordings
