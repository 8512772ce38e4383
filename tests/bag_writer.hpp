#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace touchdown::test {

/// Payload of a message in CDR, written by the rules of the standard alone.
class CdrBytes {
 public:
  explicit CdrBytes(bool is_big_endian = false);
  CdrBytes& u8(std::uint8_t value);
  CdrBytes& u32(std::uint32_t value);
  CdrBytes& f32(float value);
  CdrBytes& f64(double value);
  CdrBytes& text(std::string_view text);
  CdrBytes& f64s(const std::vector<double>& values);
  const std::string& bytes() const { return bytes_; }

 private:
  void put(std::uint64_t bits, std::size_t size);
  std::string bytes_;
  bool is_big_ = false;
};

struct TestJoints {
  std::vector<std::string> name;
  std::vector<double> position, velocity, effort;
};
struct TestImu {
  std::array<double, 4> orientation{0.0, 0.0, 0.0, 1.0};  ///< x y z w
  std::array<double, 3> angular_velocity{};
  std::array<double, 3> linear_acceleration{0.0, 0.0, 9.81};
  double orientation_covariance = 0.0;
};
std::string joint_state_cdr(std::int64_t stamp, const TestJoints& joints, bool is_big = false,
                            std::string_view frame = "");
std::string imu_cdr(std::int64_t stamp, const TestImu& imu, bool is_big = false,
                    std::string_view frame = "imu_link");

struct TestTopic {
  std::string name, type;
  std::string encoding = "cdr";
  std::string definition = "# fields";
};
struct TestMessage {
  std::size_t topic = 0;
  std::int64_t time = 0;  ///< of recording (ns)
  std::string data;
};

/// A bag in memory, as the tests write it.
struct TestBag {
  std::vector<TestTopic> topics;
  std::vector<TestMessage> messages;
};

struct McapOptions {
  std::string compression;     ///< of chunks: "", "lz4", "zstd"
  std::size_t per_chunk = 10;  ///< messages; 0: no chunks
  bool has_summary = true;
  bool has_crc = true;
  bool has_unknown_records = false;
};

/// The bytes of an MCAP file.
std::string mcap_bytes(const TestBag& bag, const McapOptions& options = {});
/// One record: opcode, length and content.
std::string mcap_record(std::uint8_t op, std::string_view content);

/// Writes a SQLite bag. With `zstd` each payload is compressed.
void write_db3(const TestBag& bag, const std::filesystem::path& path, bool zstd = false,
               bool has_index = true);

/// Runs statements on the SQLite database of this path, which is made if it is missing.
void run_sql(const std::filesystem::path& path, const std::string& sql);

std::string zstd_compressed(std::string_view bytes);
std::string lz4_compressed(std::string_view bytes);

}  // namespace touchdown::test
