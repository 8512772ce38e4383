#pragma once

#include <map>
#include <string>

#include "estimator/bayes/config.hpp"

namespace touchdown::test {

inline BayesFilterConfig named(const std::string& name) {
  const std::map<std::string, BayesFilterConfig> all = {
      {"paper", BayesFilterConfig::paper()},
      {"paper_rms", BayesFilterConfig::paper_rms()},
      {"reference", BayesFilterConfig::reference()},
      {"robust", BayesFilterConfig::robust()}};
  return all.at(name);
}

}  // namespace touchdown::test
