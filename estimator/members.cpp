#include "estimator/members.hpp"

#include "core/error.hpp"
#include "estimator/numerics/number_text.hpp"

namespace touchdown {

void RangeCheck::operator()(const std::string& key, double value, const Range& range) const {
  if (value >= range.low && value <= range.high) return;  // written so that NaN fails
  throw InputError(key + ": expected " + range.text + ", found " + text_of(value));
}

}  // namespace touchdown
