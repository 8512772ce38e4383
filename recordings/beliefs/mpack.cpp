#include "recordings/beliefs/mpack.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"
#include "recordings/log/packing.hpp"

namespace touchdown::recordings {

namespace {

/// Far more than beliefs need. A header that announces more is rejected.
const msgpack::unpack_limit limits(64, 64, 1024, 1024, 1024, 4);

std::optional<double> number_of(const msgpack::object& value) {
  switch (value.type) {
    case msgpack::type::BOOLEAN:
      return value.via.boolean ? 1.0 : 0.0;
    case msgpack::type::POSITIVE_INTEGER:
      return static_cast<double>(value.via.u64);
    case msgpack::type::NEGATIVE_INTEGER:
      return static_cast<double>(value.via.i64);
    case msgpack::type::FLOAT32:
    case msgpack::type::FLOAT64:
      return value.via.f64;
    default:
      return std::nullopt;
  }
}

/// Reads one dictionary after the other. All must have the names of the first.
class DictionaryReader {
 public:
  explicit DictionaryReader(const std::filesystem::path& path) {
    columns_.beliefs.file = path.string();
  }

  [[noreturn]] void complain(const std::string& what) const {
    throw InputError(
        fmt::format("{}: dictionary {}: {}", columns_.beliefs.file, columns_.beliefs.size(), what));
  }

  void take(const msgpack::object& object) {
    if (object.type != msgpack::type::MAP) complain("expected a dictionary");
    const std::span entries(object.via.map.ptr, object.via.map.size);
    std::vector<std::string> names;
    for (const msgpack::object_kv& entry : entries) {
      if (entry.key.type != msgpack::type::STR) complain("expected names for keys");
      names.emplace_back(entry.key.via.str.ptr, entry.key.via.str.size);
    }
    if (names_.empty() || names != names_) {
      if (!names_.empty() && sorted(names) != sorted(names_)) {
        complain(fmt::format("expected the names of the first: {}", fmt::join(names_, ", ")));
      }
      check(columns_.set_names(names));
      names_ = names;
    }
    std::vector<double> values;
    for (const msgpack::object_kv& entry : entries) {
      const std::optional<double> number = number_of(entry.val);
      if (!number) complain(names[values.size()] + ": expected a number");
      values.push_back(*number);
    }
    check(columns_.add(values));
  }

  Beliefs finish() {
    if (columns_.beliefs.size() == 0) {
      throw InputError(fmt::format("{}: holds no beliefs", columns_.beliefs.file));
    }
    return std::move(columns_.beliefs);
  }

 private:
  static std::vector<std::string> sorted(std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    return names;
  }
  void check(const std::optional<ColumnError>& wrong) const {
    if (wrong) complain(wrong->what);
  }

  BeliefColumns columns_;
  std::vector<std::string> names_;
};

}  // namespace

Beliefs read_belief_mpack(const std::filesystem::path& path) {
  require_file(path);
  const std::string bytes = read_file(path);
  DictionaryReader reader(path);
  std::size_t offset = 0;
  while (offset < bytes.size()) {
    msgpack::object_handle handle;
    try {
      handle = msgpack::unpack(bytes.data(), bytes.size(), offset, nullptr, nullptr, limits);
    } catch (const msgpack::insufficient_bytes&) {
      reader.complain("is cut off");
    } catch (const msgpack::unpack_error&) {
      reader.complain(fmt::format("is not a MessagePack dictionary of beliefs (byte {})", offset));
    }
    reader.take(handle.get());
  }
  return reader.finish();
}

}  // namespace touchdown::recordings
