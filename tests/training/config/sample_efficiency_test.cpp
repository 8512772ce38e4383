#include "training/config/sample_efficiency.hpp"

#include <gmock/gmock.h>

#include "core/error.hpp"

namespace touchdown::training {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

YamlDocument document(const std::string& text) { return YamlDocument::parse(text, "s.yaml"); }

TEST(SampleEfficiency, ItsFileIsDistinguishedFromATraining) {
  const std::string folder = TOUCHDOWN_SOURCE_DIR "/experiments/";
  const YamlDocument study = YamlDocument::load(folder + "sample_efficiency.yaml");
  EXPECT_TRUE(is_sample_efficiency(study));
  EXPECT_FALSE(is_sample_efficiency(YamlDocument::load(folder + "nmn.yaml")));
  const std::string text = to_yaml(sample_efficiency_from_yaml(study));
  EXPECT_EQ(to_yaml(sample_efficiency_from_yaml(document(text))), text);
}

TEST(SampleEfficiency, NamesTheWrongValue) {
  const auto complaint = [](const char* text, const char* message) {
    EXPECT_THAT([&] { sample_efficiency_from_yaml(document(text)); },
                ThrowsMessage<InputError>(HasSubstr(message)));
  };
  complaint("{name: x, estimator: upkie_observer}", "expected a Bayes filter");
  complaint("{name: x, network_seconds: [8, 4]}", "increasing");
  complaint("{name: x, simulators: [bulet]}", "bulet");
  complaint("{name: x, amount: [8]}", "amount");
}

}  // namespace
}  // namespace touchdown::training
