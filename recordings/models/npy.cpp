#include "recordings/models/npy.hpp"

#include <bit>
#include <cstring>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::recordings {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

std::string to_npy(const NpyArray& array) {
  const std::size_t count =
      std::accumulate(array.shape.begin(), array.shape.end(), std::size_t{1}, std::multiplies<>());
  if (array.shape.empty() || array.shape.size() > 2 || count != array.data.size()) {
    throw Error("the shape of an array to be written does not match its size");
  }
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}), }}",
                  array.shape.size() == 1 ? fmt::format("{},", array.shape[0])
                                          : fmt::format("{}, {}", array.shape[0], array.shape[1]));
  // NumPy requires the data to begin at a multiple of 64 bytes, after a line break.
  while ((npy_magic.size() + 4 + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';

  std::string bytes(npy_magic);
  bytes += '\x01';
  bytes += '\x00';
  bytes += static_cast<char>(header.size() & 0xffU);
  bytes += static_cast<char>(header.size() >> 8U);
  bytes += header;
  const std::size_t start = bytes.size();
  bytes.resize(start + count * sizeof(double));
  if (count > 0) std::memcpy(bytes.data() + start, array.data.data(), count * sizeof(double));
  return bytes;
}

}  // namespace touchdown::recordings
