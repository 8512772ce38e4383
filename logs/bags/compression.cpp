#include "logs/bags/compression.hpp"

#include <algorithm>
#include <fstream>
#include <lz4frame.h>
#include <memory>
#include <vector>
#include <zstd.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/stop.hpp"

namespace touchdown::logs {

namespace {

constexpr std::size_t step_bytes = std::size_t{1} << 17U;
constexpr const char* ends_early = "its compressed bytes end early";

struct FreeLz4 {
  void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};
struct FreeZstd {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

/// Makes room for the next step at the end of the buffer; returns its size, 0 at the limit.
std::size_t grow(std::string& bytes, std::size_t used, std::uint64_t limit) {
  const auto room = static_cast<std::size_t>(std::min<std::uint64_t>(step_bytes, limit - used));
  bytes.resize(used + room);
  return room;
}

/// One step of a decompressor: consumes input, gives output, and reports whether a frame ended.
struct Step {
  std::size_t consumed = 0;
  std::size_t produced = 0;
  bool is_frame_end = false;
  std::string fault = {};
};

template <typename Decompress>
Decompressed decompress_frames(std::string_view compressed, std::uint64_t limit,
                               const Decompress& decompress_step) {
  Decompressed result;
  std::size_t used = 0;
  bool is_frame_end = false;
  char beyond = 0;  // the last frame may still need a call without output
  while (!compressed.empty() || !is_frame_end) {
    const std::size_t room = grow(result.bytes, used, limit);
    char* const to = room == 0 ? &beyond : result.bytes.data() + used;
    const Step step = decompress_step(compressed, to, std::max<std::size_t>(room, 1));
    if (room == 0 && step.produced > 0) {
      result.fault = "it holds more bytes than it declares";
      break;
    }
    used += step.produced;
    compressed.remove_prefix(step.consumed);
    is_frame_end = step.is_frame_end;
    if (!step.fault.empty()) {
      result.fault = step.fault;
      break;
    }
    if (step.consumed == 0 && step.produced == 0 && !is_frame_end) {
      result.fault = ends_early;
      break;
    }
  }
  result.bytes.resize(used);
  return result;
}

Decompressed decompress_lz4(std::string_view compressed, std::uint64_t limit) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0U) {
    throw Error("lz4: no memory");
  }
  const std::unique_ptr<LZ4F_dctx, FreeLz4> context(made);
  return decompress_frames(
      compressed, limit, [&](std::string_view from, char* to, std::size_t room) {
        std::size_t produced = room;
        std::size_t consumed = from.size();
        const std::size_t left =
            LZ4F_decompress(context.get(), to, &produced, from.data(), &consumed, nullptr);
        if (LZ4F_isError(left) != 0U) return Step{0, 0, false, LZ4F_getErrorName(left)};
        return Step{consumed, produced, left == 0};
      });
}

std::unique_ptr<ZSTD_DCtx, FreeZstd> zstd_context() {
  std::unique_ptr<ZSTD_DCtx, FreeZstd> context(ZSTD_createDCtx());
  if (!context) throw Error("zstd: no memory");
  return context;
}

Decompressed decompress_zstd(std::string_view compressed, std::uint64_t limit) {
  const auto context = zstd_context();
  return decompress_frames(
      compressed, limit, [&](std::string_view from, char* to, std::size_t room) {
        ZSTD_inBuffer in{from.data(), from.size(), 0};
        ZSTD_outBuffer out{to, room, 0};
        const std::size_t left = ZSTD_decompressStream(context.get(), &out, &in);
        if (ZSTD_isError(left) != 0U) return Step{in.pos, out.pos, false, ZSTD_getErrorName(left)};
        return Step{in.pos, out.pos, left == 0};
      });
}

}  // namespace

Decompressed decompress(Compression compression, std::string_view compressed, std::uint64_t limit) {
  if (compression == Compression::none) {
    if (compressed.size() > limit) {
      return {std::string(compressed.substr(0, limit)), "it holds more bytes than it declares"};
    }
    return {std::string(compressed), ""};
  }
  if (compressed.empty()) return {"", limit == 0 ? "" : ends_early};
  return compression == Compression::lz4 ? decompress_lz4(compressed, limit)
                                         : decompress_zstd(compressed, limit);
}

bool is_zstd(std::string_view bytes) { return bytes.starts_with("\x28\xb5\x2f\xfd"); }

void decompress_file(const std::filesystem::path& compressed, const std::filesystem::path& path,
                     const std::atomic<bool>* stop) {
  std::ifstream from(compressed, std::ios::binary);
  std::ofstream to(path, std::ios::binary);
  if (!to) throw Error(fmt::format("{}: cannot be written", path.string()));
  const auto context = zstd_context();
  std::vector<char> in_bytes(ZSTD_DStreamInSize());
  std::vector<char> out_bytes(ZSTD_DStreamOutSize());
  std::size_t left = 0;
  bool has_bytes = false;
  while (from.read(in_bytes.data(), static_cast<std::streamsize>(in_bytes.size())),
         from.gcount() > 0) {
    end_if(stop);
    has_bytes = true;
    ZSTD_inBuffer in{in_bytes.data(), static_cast<std::size_t>(from.gcount()), 0};
    // A full output buffer may hide output that still waits in the decompressor, but not at the end
    // of a frame.
    for (bool is_full = false; in.pos < in.size || is_full;) {
      ZSTD_outBuffer out{out_bytes.data(), out_bytes.size(), 0};
      left = ZSTD_decompressStream(context.get(), &out, &in);
      if (ZSTD_isError(left) != 0U) {
        throw InputError(fmt::format("{}: cannot be decompressed: {}", compressed.string(),
                                     ZSTD_getErrorName(left)));
      }
      to.write(out_bytes.data(), static_cast<std::streamsize>(out.pos));
      is_full = left != 0 && out.pos == out.size;
    }
  }
  if (!has_bytes || left != 0) {
    throw InputError(
        fmt::format("{}: its compressed bytes end early: was the recorder stopped? Copy the file "
                    "again, or give "
                    "the files before it",
                    compressed.string()));
  }
  to.close();
  if (!to) {
    throw Error(fmt::format("{}: cannot be decompressed to {}: is the disk full?",
                            compressed.string(), path.string()));
  }
}

}  // namespace touchdown::logs
