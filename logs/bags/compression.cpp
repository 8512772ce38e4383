#include "logs/bags/compression.hpp"

#include <fstream>
#include <functional>
#include <lz4frame.h>
#include <memory>
#include <span>
#include <utility>
#include <vector>
#include <zstd.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/stop.hpp"

namespace touchdown::logs {

namespace {

constexpr std::size_t step_bytes = std::size_t{1} << 17U;
constexpr const char* ends_early = "its compressed bytes end early";

/// One step of a decompressor: consumes input, gives output, and reports whether a frame ended.
struct Step {
  std::size_t consumed = 0;
  std::size_t produced = 0;
  bool is_frame_end = false;
  std::string fault = {};
};
using Decompressor = std::function<Step(std::string_view from, std::span<char> to)>;

/// Decompresses whole frames. `next` gives bytes, and none at their end; `take` returns false to
/// end early. Returns what ended it early.
std::string decompress_frames(const Decompressor& step,
                              const std::function<std::string_view()>& next,
                              const std::function<bool(std::string_view)>& take) {
  std::vector<char> to(step_bytes);
  std::string_view from = next();
  bool is_frame_end = false;
  while (!from.empty() || !is_frame_end) {
    const Step done = step(from, to);
    if (!take({to.data(), done.produced})) return "it holds more bytes than it declares";
    if (!done.fault.empty()) return done.fault;
    from.remove_prefix(done.consumed);
    is_frame_end = done.is_frame_end;
    const bool is_stuck = done.consumed == 0 && done.produced == 0 && !is_frame_end;
    if (is_stuck && !from.empty()) return ends_early;
    if (from.empty()) from = next();
    if (is_stuck && from.empty()) return ends_early;
  }
  return {};
}

Decompressor lz4() {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0U) {
    throw Error("lz4: no memory");
  }
  const std::shared_ptr<LZ4F_dctx> context(made, LZ4F_freeDecompressionContext);
  return [context](std::string_view from, std::span<char> to) {
    std::size_t produced = to.size();
    std::size_t consumed = from.size();
    const std::size_t left =
        LZ4F_decompress(context.get(), to.data(), &produced, from.data(), &consumed, nullptr);
    if (LZ4F_isError(left) != 0U) return Step{0, 0, false, LZ4F_getErrorName(left)};
    return Step{consumed, produced, left == 0};
  };
}

Decompressor zstd() {
  const std::shared_ptr<ZSTD_DCtx> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  if (!context) throw Error("zstd: no memory");
  return [context](std::string_view from, std::span<char> to) {
    ZSTD_inBuffer in{from.data(), from.size(), 0};
    ZSTD_outBuffer out{to.data(), to.size(), 0};
    const std::size_t left = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(left) != 0U) return Step{in.pos, out.pos, false, ZSTD_getErrorName(left)};
    return Step{in.pos, out.pos, left == 0};
  };
}

}  // namespace

Decompressed decompress(Compression compression, std::string_view compressed, std::uint64_t limit) {
  Decompressed result;
  const auto take = [&](std::string_view bytes) {
    const std::uint64_t room = limit - result.bytes.size();
    result.bytes.append(bytes.substr(0, room));
    return bytes.size() <= room;
  };
  if (compression == Compression::none) {
    if (!take(compressed)) result.fault = "it holds more bytes than it declares";
  } else if (!compressed.empty() || limit > 0) {
    result.fault = decompress_frames(
        compression == Compression::lz4 ? lz4() : zstd(),
        [&] { return std::exchange(compressed, {}); }, take);
  }
  return result;
}

bool is_zstd(std::string_view bytes) { return bytes.starts_with("\x28\xb5\x2f\xfd"); }

void decompress_file(const std::filesystem::path& compressed, const std::filesystem::path& path,
                     const std::atomic<bool>* stop) {
  std::ifstream from(compressed, std::ios::binary);
  std::ofstream to(path, std::ios::binary);
  if (!to) throw Error(fmt::format("{}: cannot be written", path.string()));
  std::vector<char> read(step_bytes);
  const auto next = [&] {
    end_if(stop);
    from.read(read.data(), static_cast<std::streamsize>(read.size()));
    return std::string_view(read.data(), static_cast<std::size_t>(from.gcount()));
  };
  const std::string fault = decompress_frames(zstd(), next, [&](std::string_view bytes) {
    to.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return true;
  });
  if (fault == ends_early) {
    throw InputError(
        fmt::format("{}: its compressed bytes end early: was the recorder stopped? Copy the file "
                    "again, or give "
                    "the files before it",
                    compressed.string()));
  }
  if (!fault.empty()) {
    throw InputError(fmt::format("{}: cannot be decompressed: {}", compressed.string(), fault));
  }
  to.close();
  if (!to) {
    throw Error(fmt::format("{}: cannot be decompressed to {}: is the disk full?",
                            compressed.string(), path.string()));
  }
}

}  // namespace touchdown::logs
