#include "estimator/models/metadata.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/error.hpp"
#include "core/fingerprint.hpp"
#include "estimator/numerics/number_text.hpp"

namespace touchdown {

namespace {

constexpr std::string_view format = "1";
constexpr std::string_view units = "SI";
constexpr std::string_view configuration_prefix = "configuration.";
constexpr std::string_view fingerprint_key = "fingerprint";

std::string hexadecimal(std::uint64_t number) {
  std::string digits(16, '0');
  for (std::size_t i = digits.size(); i-- > 0; number >>= 4U) {
    digits[i] = "0123456789abcdef"[number & 0xfU];
  }
  return digits;
}

/// As lines, without the fingerprint.
std::string lines_of(const ModelMetadata& metadata) {
  std::string lines;
  const auto line = [&](std::string_view key, std::string_view value) {
    lines.append(key).append(": ").append(value).append("\n");
  };
  line("format", format);
  line("estimator", metadata.estimator);
  line("sample_rate", text_of(metadata.sample_rate));
  line("robot", metadata.robot);
  line("units", units);
  for (const auto& [key, value] : metadata.configuration) {
    line(std::string(configuration_prefix) + key, value);
  }
  return lines;
}

std::string fingerprint_of(const ModelArrays& arrays, const std::string& lines) {
  Fingerprint fingerprint;
  fingerprint.add(lines);
  for (const auto& [name, array] : arrays) {
    if (name == metadata_array || name == derived_array) continue;
    fingerprint.add(name);
    for (const std::size_t axis : array.shape) fingerprint.add(std::to_string(axis));
    fingerprint.add({reinterpret_cast<const char*>(array.data.data()),  // NOLINT
                     array.data.size() * sizeof(double)});
  }
  return hexadecimal(fingerprint.value());
}

static_assert(std::endian::native == std::endian::little, "numbers are hashed as they are");

[[noreturn]] void refuse(const std::string& line) {
  throw InputError("metadata: '" + line +
                   "' is not understood: was it written by a newer version?");
}

/// Errors: `InputError` if the value differs from that of this version's files.
void expect(std::string_view key, std::string_view found, std::string_view expected) {
  if (found == expected) return;
  throw InputError("metadata: " + std::string(key) + " " + std::string(found) + ": expected " +
                   std::string(expected));
}

void take_line(const std::string& line, ModelMetadata& metadata) {
  const std::size_t colon = line.find(": ");
  if (colon == std::string::npos) refuse(line);
  const std::string key = line.substr(0, colon);
  const std::string value = line.substr(colon + 2);
  if (key == "format") {
    expect(key, value, format);
  } else if (key == "units") {
    expect(key, value, units);
  } else if (key == "estimator") {
    metadata.estimator = value;
  } else if (key == "sample_rate") {
    const std::optional<double> number = number_of(value);
    if (!number) refuse(line);
    metadata.sample_rate = *number;
  } else if (key == "robot") {
    metadata.robot = value;
  } else if (key == fingerprint_key) {
    metadata.fingerprint = value;
  } else if (key.starts_with(configuration_prefix)) {
    metadata.configuration[key.substr(configuration_prefix.size())] = value;
  } else {
    refuse(line);
  }
}

}  // namespace

std::string add_metadata(ModelArrays& arrays, const ModelMetadata& metadata) {
  for (const std::string& text : {metadata.estimator, metadata.robot}) {
    if (text.find('\n') == std::string::npos) continue;
    throw InputError("metadata: expected a name of one line, found '" + text + "'");
  }
  const std::string lines = lines_of(metadata);
  std::string fingerprint = fingerprint_of(arrays, lines);
  arrays[std::string(metadata_array)] =
      array_of_text(lines + std::string(fingerprint_key) + ": " + fingerprint + "\n");
  return fingerprint;
}

std::optional<ModelMetadata> metadata_of(const ModelArrays& arrays) {
  const auto found = arrays.find(std::string(metadata_array));
  if (found == arrays.end()) return {};
  const std::string text = text_of_array(found->second, found->first);
  ModelMetadata metadata;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    take_line(text.substr(begin, end - begin), metadata);
    begin = end + 1;
  }
  if (!(std::isfinite(metadata.sample_rate) && metadata.sample_rate > 0.0)) {
    throw InputError("metadata: expected a positive sample_rate (Hz)");
  }
  if (metadata.fingerprint != fingerprint_of(arrays, lines_of(metadata))) {
    throw InputError("its numbers are not those that were fitted (fingerprint " +
                     metadata.fingerprint + "): was the file changed?");
  }
  return metadata;
}

void check_sample_rate(const ModelUse& use) {
  if (use.sample_rate == 0.0 || (std::isfinite(use.sample_rate) && use.sample_rate > 0.0)) return;
  throw InputError(
      "sample_rate: expected a positive number (Hz), or 0 for the model's own, found " +
      text_of(use.sample_rate));
}

bool is_same_rate(double rate, double other) {
  constexpr double tolerance = 0.01;
  return std::abs(rate - other) <= tolerance * other;
}

/// The lowest and the highest rate at which a model may be used (Hz): those that its estimator was
/// measured at (docs/results.md), and the fitted one.
static std::pair<double, double> served_rates(const ModelMetadata& metadata) {
  // The filter of loads has no fit, and constants in seconds.
  if (metadata.estimator == load_filter_name) return {100.0, 20'000.0};
  return {metadata.sample_rate, metadata.sample_rate};
}

void check_use(const ModelMetadata& metadata, const ModelUse& use) {
  check_sample_rate(use);
  const auto [lowest, highest] = served_rates(metadata);
  const double rate = use.sample_rate;
  const bool is_served = (rate >= lowest && rate <= highest) || is_same_rate(rate, lowest) ||
                         is_same_rate(rate, highest);
  if (rate > 0.0 && !is_served) {
    const std::string range =
        lowest < highest ? " and serves " + text_of(lowest) + " to " + text_of(highest) + " Hz"
                         : std::string();
    throw InputError("was fitted at " + text_of(metadata.sample_rate) + " Hz" + range +
                     ", not at " + text_of(rate) + " Hz");
  }
  if (!use.robot.empty() && !metadata.robot.empty() && use.robot != metadata.robot) {
    throw InputError("was fitted to the robot '" + metadata.robot + "', not to '" + use.robot +
                     "'");
  }
}

}  // namespace touchdown
