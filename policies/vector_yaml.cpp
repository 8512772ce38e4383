#include "policies/vector_yaml.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace touchdown::policies {

void describe_vector(Fields& fields, std::string_view key, Eigen::Vector3d& value) {
  std::vector<double> numbers(value.begin(), value.end());
  fields.in_line(key, numbers);
  fields.check(numbers.size() == 3 && std::all_of(numbers.begin(), numbers.end(),
                                                  [](double x) { return std::isfinite(x); }),
               key, "expected three numbers: x, y, z");
  value = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

}  // namespace touchdown::policies
