// Classes of effects that poses cannot tell apart, as people read them.
#include "report/effect_class.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace demecal {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

Effect effect_of(const char* kind, int joint) {
  return {.kind = kind, .joint = joint};
}

TEST(EffectClass, HasTheMoreCommonCauseFirstWhicheverTheModelHolds) {
  Round scale;
  scale.effect = effect_of("sensor_scale", -1);
  scale.rivals = {{effect_of("geometry", 2), 0.99, 0.0}, {effect_of("geometry", 1), 0.985, 0.0}};
  EXPECT_EQ(class_words(effect_class(scale)), "link geometry of joints 2 and 3 or instrument scale");
  Round links;
  links.effect = effect_of("geometry", 1);
  links.rivals = {{effect_of("sensor_scale", -1), 0.99, 0.0}, {effect_of("geometry", 2), 0.985, 0.0}};
  EXPECT_EQ(class_words(effect_class(links)), class_words(effect_class(scale)));
  EXPECT_EQ(class_sentence(effect_class(links)),
            "Link geometry of joints 2 and 3 or instrument scale: these poses cannot tell.");
}

TEST(EffectClass, SaysAJointThatAllShareOnce) {
  Round round;
  round.effect = effect_of("hysteresis", 1);
  round.rivals = {{effect_of("backlash", 1), 1.0, 0.0}, {effect_of("backlash", 1), 0.99, 0.0}};
  EXPECT_EQ(class_words(effect_class(round)), "backlash or friction hysteresis of joint 2");
  EXPECT_THAT(effect_class(round), SizeIs(2));
}

TEST(EffectClass, IsNoneWhereNoRivalIsAsGood) {
  Round round;
  round.effect = effect_of("backlash", 1);
  EXPECT_THAT(effect_class(round), IsEmpty());
  round.rivals = {{effect_of("hysteresis", 1), 0.97, 0.0}};
  EXPECT_THAT(effect_class(round), IsEmpty());
  EXPECT_EQ(class_sentence({}), "");
}

}  // namespace
}  // namespace demecal
