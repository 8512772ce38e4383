#include "recordings/log/annotator.hpp"

#include "core/error.hpp"
#include "recordings/log/packing.hpp"

namespace touchdown::recordings {

namespace {

/// Packs beliefs as three maps.
class BeliefPacker {
 public:
  BeliefPacker(LogPacker& packer, msgpack::sbuffer& buffer) : packer_(packer), buffer_(buffer) {}

  void group(std::string_view key, std::uint32_t size) {
    pack_text(packer_, key);
    packer_.pack_map(size);
  }
  void number(std::string_view key, double value) {
    pack_text(packer_, key);
    pack_float64(buffer_, value);
  }
  void wheel(std::string_view key, const WheelBelief& belief) {
    group(key, 2);
    number("p_contact", belief.p_contact);
    pack_text(packer_, "contact");
    belief.contact ? packer_.pack_true() : packer_.pack_false();
  }
  void text(std::string_view key, std::string_view value) {
    pack_text(packer_, key);
    pack_text(packer_, value);
  }

 private:
  LogPacker& packer_;
  msgpack::sbuffer& buffer_;
};

void pack_beliefs(BeliefPacker out, const LogBeliefs& beliefs) {
  out.group(belief_groups[0], 3);
  out.number("contact_likelihood", beliefs.contact_likelihood);
  out.number("no_contact_likelihood", beliefs.no_contact_likelihood);
  out.number("p_contact", beliefs.measurement_p_contact);
  out.group(belief_groups[1], 7);
  out.number("power", beliefs.power);
  out.number("median_frequency", beliefs.median_frequency);
  out.number("filtered_median_freq", beliefs.filtered_median_frequency);
  out.number("p_switch", beliefs.p_switch);
  out.number("p_landing", beliefs.p_landing);
  out.number("p_landing_p_switch", beliefs.p_landing_p_switch);
  out.number("p_takeoff_p_switch", beliefs.p_takeoff_p_switch);
  out.group(belief_groups[2], 7);
  out.number("p_contact", beliefs.p_contact);
  out.number("p_contact_smooth", beliefs.p_contact_smooth);
  out.wheel("left_wheel", beliefs.wheel[0]);
  out.wheel("right_wheel", beliefs.wheel[1]);
  out.number("p_any_wheel", beliefs.p_any_wheel);
  out.number("p_both_wheels", beliefs.p_both_wheels);
  out.text("status", to_text(beliefs.status));
}

}  // namespace

void LogAnnotator::copy(std::string_view records) {
  stream_.write(records.data(), static_cast<std::streamsize>(records.size()));
  if (!stream_) throw Error("the annotated log cannot be written: is the disk full?");
}

void LogAnnotator::annotate(std::string_view record, const ObservationOutline& outline,
                            const LogBeliefs& beliefs) {
  const bool has_header = outline.header > 0 && outline.header < record.size();
  const std::size_t header_size = has_header ? map_header_size(record[outline.header]) : 0;
  if (header_size == 0) throw InputError("a record without an observation cannot be annotated");

  buffer_.clear();
  buffer_.write(record.data(), outline.header);
  packer_.pack_map(
      static_cast<std::uint32_t>(outline.entries - outline.beliefs.size() + belief_groups.size()));
  pack_beliefs({packer_, buffer_}, beliefs);
  std::size_t copied = outline.header + header_size;
  for (const ObservationOutline::Range& old : outline.beliefs) {
    buffer_.write(record.data() + copied, old.begin - copied);
    copied = old.end;
  }
  buffer_.write(record.data() + copied, record.size() - copied);
  copy({buffer_.data(), buffer_.size()});
}

}  // namespace touchdown::recordings
