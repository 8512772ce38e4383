#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace touchdown::logs {

enum class Compression : int { none, lz4, zstd };

/// Result of a decompression. `fault` names what ended it early; the bytes before it are valid.
struct Decompressed {
  std::string bytes;
  std::string fault;  ///< empty if complete
};

/// Decompresses whole frames. The buffer grows with the bytes that were decompressed, never with a
/// declared size; more than `limit` bytes are a fault.
Decompressed decompress(Compression compression, std::string_view compressed, std::uint64_t limit);

/// Whether the bytes begin with a zstd frame.
bool is_zstd(std::string_view bytes);

/// Decompresses the file `compressed` into the file `path`. Errors: `InputError` for bytes that are
/// no zstd frames, or that end early; `Error` when the file cannot be written; `Stopped` once
/// `stop`, which may be null, is true.
void decompress_file(const std::filesystem::path& compressed, const std::filesystem::path& path,
                     const std::atomic<bool>* stop = nullptr);

}  // namespace touchdown::logs
