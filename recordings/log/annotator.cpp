#include "recordings/log/annotator.hpp"

#include "core/error.hpp"
#include "recordings/log/outline.hpp"
#include "recordings/log/packing.hpp"

namespace touchdown::recordings {

namespace {

/// Packs a belief as three maps.
void pack_beliefs(LogPacker& packer, msgpack::sbuffer& buffer, const Belief& belief,
                  const Evidence& evidence) {
  const auto group = [&](std::string_view key, std::uint32_t size) {
    pack_text(packer, key);
    packer.pack_map(size);
  };
  const auto number = [&](std::string_view key, double value) {
    pack_text(packer, key);
    pack_float64(buffer, value);
  };
  const auto wheel = [&](std::string_view key, const WheelBelief& of_wheel) {
    group(key, 2);
    number("p_contact", of_wheel.p_contact);
    pack_text(packer, "contact");
    of_wheel.contact ? packer.pack_true() : packer.pack_false();
  };
  const Evidence::Measurement& measurement = evidence.wheel[0];
  const Evidence::Transition& transition = evidence.transition;
  group(belief_groups[0], 3);
  number("contact_likelihood", measurement.contact_likelihood);
  number("no_contact_likelihood", measurement.no_contact_likelihood);
  number("p_contact", measurement.p_contact);
  group(belief_groups[1], 7);
  number("power", transition.power);
  number("median_frequency", transition.median_frequency);
  number("filtered_median_freq", transition.filtered_median_frequency);
  number("p_switch", transition.p_switch);
  number("p_landing", transition.p_landing_if_switch);
  number("p_landing_p_switch", transition.p_landing);
  number("p_takeoff_p_switch", transition.p_takeoff);
  group(belief_groups[2], 7);
  number("p_contact", belief.wheel[0].p_contact);
  number("p_contact_smooth", Evidence::unknown);
  wheel("left_wheel", belief.wheel[0]);
  wheel("right_wheel", belief.wheel[1]);
  number("p_any_wheel", belief.p_any_wheel);
  number("p_both_wheels", belief.p_both_wheels);
  pack_text(packer, "status");
  pack_text(packer, to_text(belief.status));
}

}  // namespace

void LogAnnotator::copy(std::string_view records) {
  stream_.write(records.data(), static_cast<std::streamsize>(records.size()));
  if (!stream_) throw Error("the annotated log cannot be written: is the disk full?");
}

void LogAnnotator::annotate(std::string_view record, const Belief& belief,
                            const Evidence& evidence) {
  const ObservationOutline outline = outline_of(record);
  if (outline.header == 0) throw InputError("a record without an observation cannot be annotated");
  const std::size_t header_size = map_header_size(record[outline.header]);

  buffer_.clear();
  buffer_.write(record.data(), outline.header);
  packer_.pack_map(
      static_cast<std::uint32_t>(outline.entries - outline.beliefs.size() + belief_groups.size()));
  pack_beliefs(packer_, buffer_, belief, evidence);
  std::size_t copied = outline.header + header_size;
  for (const ObservationOutline::Range& old : outline.beliefs) {
    buffer_.write(record.data() + copied, old.begin - copied);
    copied = old.end;
  }
  buffer_.write(record.data() + copied, record.size() - copied);
  copy({buffer_.data(), buffer_.size()});
}

}  // namespace touchdown::recordings
