#pragma once

#include <cstdint>
#include <limits>

namespace touchdown::scoring {

/// `part` / `whole`; NaN if `whole` is zero.
inline double ratio(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(part) / static_cast<double>(whole);
}

/// Point-wise confusion counts of one or many sequences, `<truth>_as_<prediction>`. They are sums
/// over steps, so they add. docs/reference/metrics.md, "Point-wise", defines the metrics; NaN if a
/// denominator is zero.
struct Classification {
  std::int64_t contact_as_contact = 0;
  std::int64_t contact_as_flight = 0;
  std::int64_t flight_as_contact = 0;
  std::int64_t flight_as_flight = 0;

  void add(bool truth, bool predicted) {
    (truth ? (predicted ? contact_as_contact : contact_as_flight)
           : (predicted ? flight_as_contact : flight_as_flight)) += 1;
  }

  Classification& operator+=(const Classification& other) {
    contact_as_contact += other.contact_as_contact;
    contact_as_flight += other.contact_as_flight;
    flight_as_contact += other.flight_as_contact;
    flight_as_flight += other.flight_as_flight;
    return *this;
  }

  std::int64_t contact() const { return contact_as_contact + contact_as_flight; }
  std::int64_t flight() const { return flight_as_contact + flight_as_flight; }
  std::int64_t points() const { return contact() + flight(); }

  double success() const { return ratio(contact_as_contact + flight_as_flight, points()); }
  double contact_precision() const {
    return ratio(contact_as_contact, contact_as_contact + flight_as_contact);
  }
  double contact_recall() const { return ratio(contact_as_contact, contact()); }
  double no_contact_precision() const {
    return ratio(flight_as_flight, flight_as_flight + contact_as_flight);
  }
  double no_contact_recall() const { return ratio(flight_as_flight, flight()); }
  /// The mean of the two recalls; if only one of the two states occurred, its recall.
  double balanced_accuracy() const {
    if (flight() == 0) return contact_recall();
    if (contact() == 0) return no_contact_recall();
    return 0.5 * (contact_recall() + no_contact_recall());
  }

  friend bool operator==(const Classification&, const Classification&) = default;
};

}  // namespace touchdown::scoring
